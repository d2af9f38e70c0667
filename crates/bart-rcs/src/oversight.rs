//! Limits and reporting of a run: errors, memory limits, progress.

pub(crate) mod error; // errors of a body or an antenna
pub(crate) mod memory; // prediction, monitoring and limits
pub(crate) mod progress; // progress reports
pub(crate) mod work_meter; // processor time by aspect
