//! Our way beside a rival.

use crate::bench::programs::NotHere;

/// One comparison.
pub(super) struct Comparison {
    pub(super) name: String,
    pub(super) ours_s: f64,
    /// Name of the rival that did the same work, and its seconds.
    pub(super) rival: Result<(String, f64), NotHere>,
    /// Error of our result against the rival's, relative amplitude.
    pub(super) error: Option<f64>,
    pub(super) work: String,
}
