//! Distances of a set of estimates from a set of truths.

pub(crate) mod distances; // squares between places
pub(crate) mod gospa; // generalised optimal sub-pattern assignment
pub(crate) mod ospa; // optimal sub-pattern assignment
pub(crate) mod identities; // of bodies and tracks
