//! Outcome of a run: `summary.json`, the verdict on the accuracy, false objects and tracks, and the lines for
//! a console.

pub mod error_figures;
pub(crate) mod useful_accuracy;
pub mod verdict;
pub mod frame_truth;
pub(crate) mod false_objects;
pub mod summary;
pub mod tracking;
pub mod console_lines;
