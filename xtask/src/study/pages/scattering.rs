//! Studies of scattered fields: against reference data, the two slow references, and finer answers.

mod bodies;
mod frames;
mod roads;
pub(crate) mod continuity;
pub(crate) mod error_estimates;
pub(crate) mod gates;
pub(crate) mod published_levels;
pub(crate) mod wheels;
pub(crate) mod references;
