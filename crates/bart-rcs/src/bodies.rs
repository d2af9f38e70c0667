//! Posed meshes, and the road below them.

pub(crate) mod road_mirror; // the plane z = 0
pub(crate) mod motion; // motion of bodies and of their images
pub(crate) mod behind_array; // half-space without gain
pub(crate) mod models; // meshes in their own axes, rotating wheels separate
pub(crate) mod body_gains; // weight of each body's echo
pub(crate) mod separate_wheels; // wheels as separate bodies, joined to their vehicles again
pub(crate) mod world; // facets of posed bodies
pub(crate) mod road; // unfolded images of bodies
pub(crate) mod stand_off; // permitted positions of antennas
