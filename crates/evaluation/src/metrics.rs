//! Distances between a set of estimates and a set of truths.

pub(crate) mod distances; // squared distances between places
pub(crate) mod gospa; // generalised optimal sub-pattern assignment
pub(crate) mod ospa; // optimal sub-pattern assignment
pub(crate) mod identities; // track continuity
