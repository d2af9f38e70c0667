//! Comparison of our method with a rival.

use crate::bench::programs::MissingProgram;

/// One comparison.
pub(crate) struct Comparison {
    pub(crate) name: String,
    pub(crate) ours_s: f64,
    /// Name of the rival that did the same work, and its seconds.
    pub(crate) rival: Result<(String, f64), MissingProgram>,
    /// Error of our result against the rival's, relative amplitude.
    pub(crate) error: Option<f64>,
    pub(crate) work: String,
}
