//! Our way beside a rival.

use crate::bench::programs::NotHere;

/// One comparison.
pub(super) struct Comparison {
    pub(super) name: String,
    pub(super) ours_s: f64,
    /// Who else did it, and in how many seconds.
    pub(super) rival: Result<(String, f64), NotHere>,
    /// Of ours against the rival's result, relative amplitude.
    pub(super) error: Option<f64>,
    pub(super) work: String,
}
