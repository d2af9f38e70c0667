//! Outcome of a run: `summary.json`, whether the accuracy was reached, false objects and tracks, and the
//! lines of a console.

pub mod error_figures;
pub(crate) mod useful_accuracy;
pub mod verdict;
pub mod frame_truth;
pub(crate) mod false_objects;
pub mod summary;
pub mod tracking;
pub mod console_lines;
