//! Posed meshes, and the road under them.

pub(crate) mod road_mirror; // the plane z = 0
pub(crate) mod motion; // how bodies, and their images in each other, move
pub(crate) mod behind_array; // where antennas hear nothing
pub(crate) mod models; // meshes in their own axes, wheels that turn apart
pub(crate) mod body_gains; // how much of each body's echo is heard
pub(crate) mod rolling; // wheels as bodies of their own, and their paths their vehicles' again
pub(crate) mod world; // facets of posed bodies
pub(crate) mod road; // bodies and their images, unfolded
pub(crate) mod stand_off; // where an antenna may stand
