//! Estimates of a single point by the receiver's two methods: peaks of the map, and maximum likelihood on the
//! samples around them.

use crate::study::chart::cost::{Cost, measured};
use crate::study::extent::Extent;
use crate::study::pages::measures::signals::bound_trials::{over_bound_db, radar};
use crate::study::pages::measures::signals::common::{elements_3x4, elements_6x8};
use artifact::settings::Refine;
use serde::{Deserialize, Serialize};
use wayside::host::failure::Failure;

/// Errors of one method, with one array at one signal-to-noise ratio.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::study) struct EstimateRow {
    pub(super) array: String,
    /// Signal over noise of a cell of one channel's unwindowed map.
    pub(super) snr_db: f64,
    pub(super) method: String,
    /// Processor milliseconds of a frame: its samples, map, detection and estimate.
    pub(super) processor_ms: f64,
    pub(super) found: f64,
    /// Root mean square error relative to the Cramér–Rao bound: range, velocity, direction cosines to the
    /// right and up.
    pub(super) over_bound_db: [Option<f64>; 4],
}

const TRIALS: u64 = 800;

/// Rows of both arrays, both methods and three levels.
pub(super) fn rows(extent: Extent) -> Result<Vec<EstimateRow>, Failure> {
    let mut rows = vec![];
    for (array, elements) in [("3x4", elements_3x4()), ("6x8", elements_6x8())] {
        for (method, refine) in [("peaks", Refine::Off), ("maximum likelihood", Refine::Isolated)] {
            let mut header = radar(elements.clone(), refine);
            header.dsp.training_cells = [4, 6];
            for snr_db in [10.0, 20.0, 30.0] {
                let trials = extent.case_count(TRIALS);
                let found = measured(|| Ok(over_bound_db(&header, snr_db, trials)))?;
                let (over_bound_db, share) = found.value;
                let Cost { processor_s, .. } = found.cost;
                rows.push(EstimateRow {
                    array: array.into(),
                    snr_db,
                    method: method.into(),
                    processor_ms: 1e3 * processor_s / trials as f64,
                    found: share,
                    over_bound_db: over_bound_db.map(|db| db.is_finite().then_some(db)),
                });
            }
        }
    }
    Ok(rows)
}
