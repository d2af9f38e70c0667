//! Third-party programs on the same work, by the comparisons of `bench`.

use crate::bench::{self, Comparison};
use crate::study::extent::Extent;
use serde::{Deserialize, Serialize};
use wayside::host::failure::Failure;

/// Comparison of our method with another program.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::study) struct RivalRow {
    pub(super) job: String,
    pub(super) work: String,
    pub(super) ours_s: f64,
    /// Name of the program, or advice for installing it.
    pub(super) rival: String,
    pub(super) rival_s: Option<f64>,
    /// Error of one method relative to the other, relative amplitude.
    pub(super) error: Option<f64>,
}

/// Every comparison, in wall-clock seconds.
pub(super) fn rows(extent: Extent) -> Result<Vec<RivalRow>, Failure> {
    let sizes = match extent {
        Extent::Quick => bench::QUICK,
        Extent::Full => bench::CHARTED,
    };
    Ok(bench::comparisons(sizes)?.into_iter().map(row).collect())
}

fn row(comparison: Comparison) -> RivalRow {
    let Comparison { name, ours_s, rival, error, work } = comparison;
    let (rival, rival_s) = match rival {
        Ok((program, seconds)) => (program, Some(seconds)),
        Err(missing) => (format!("{} is not here", missing.program), None),
    };
    RivalRow { job: name, work, ours_s, rival, rival_s, error }
}
