//! Outcome of a run: `summary.json`, whether the accuracy was reached, false objects and tracks, and the
//! lines of a console.

pub(crate) mod error_figures;
pub(crate) mod of_use;
pub(crate) mod verdict;
pub(crate) mod frame_truth;
pub(crate) mod false_objects;
pub mod summary;
pub(crate) mod tracking;
pub(crate) mod told;
