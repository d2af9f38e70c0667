//! What is told of a run: `summary.json`, whether the accuracy was reached, false objects and tracks, and the
//! lines of a console.

pub mod error_figures;
pub mod verdict;
pub mod false_objects;
pub mod summary;
pub(crate) mod tracking;
pub(crate) mod told;
