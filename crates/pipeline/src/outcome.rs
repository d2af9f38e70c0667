//! Outcome of a run: `summary.json`, the verdict on the accuracy, false objects and tracks.

pub mod error_figures;
pub(crate) mod useful_accuracy;
pub mod verdict;
pub mod frame_truth;
pub(crate) mod false_objects;
pub mod summary;
pub mod tracking;
