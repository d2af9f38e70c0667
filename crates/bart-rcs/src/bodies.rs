//! Posed meshes, and the road under them.

pub(crate) mod motion; // how bodies, and their images in each other, move
pub(crate) mod deaf_side; // where antennas hear nothing
pub(crate) mod road; // a mirror, unfolded
pub(crate) mod world; // facets of posed bodies
pub(crate) mod stand_off; // where an antenna may stand
