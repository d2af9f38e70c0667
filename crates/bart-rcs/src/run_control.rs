//! Limits and reporting of a run: errors, cancellation, memory limits, progress.

pub(crate) mod error; // errors of a body or an antenna
pub(crate) mod cancellation; // cancellation by the caller
pub(crate) mod memory; // prediction, monitoring and limits
pub(crate) mod progress; // progress reports
pub(crate) mod work_meter; // processor time by aspect
