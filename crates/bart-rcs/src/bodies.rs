//! Posed meshes, and the road under them.

pub(crate) mod road; // a mirror, unfolded
pub(crate) mod world; // facets of posed bodies
