//! Range-Doppler map (window, FFT over samples, window, FFT over chirps, for every transmit–receive pair) and
//! its detections.

use crate::detection::cfar::{self, Cfar};
use crate::detection::empty_band::keep_true_folds;
use crate::error::DspError;
use crate::spectrum::map_transform::RangeDoppler;
use crate::spectrum::noncoherent::{FLOOR_BELOW_PEAK_DB, sum_over_channels};
use artifact::cube::{CubeFrame, CubeHeader, SampleUnit};
use artifact::radar::Multiplexing;
use artifact::rdm::RdmFrame;
use artifact::settings::Noise;
use artifact::units::power_from_db;

/// Origin of the noise level that thresholds are based on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NoiseFloorOrigin {
    /// Estimated from the map's own cells.
    Estimated,
    /// Assumed below the peak of a noise-free map.
    Assumed,
}

impl NoiseFloorOrigin {
    /// Origin for a header; quantized samples always contain noise, whatever the scene specifies.
    pub(crate) fn of(header: &CubeHeader) -> Self {
        match (header.noise, header.unit) {
            (Noise::Absent, SampleUnit::RootWatts) => Self::Assumed,
            _ => Self::Estimated,
        }
    }
}

/// Whether maps of these cubes contain noise to estimate; otherwise thresholds and levels above noise are
/// based on an assumed floor below the peak.
pub fn has_noise(header: &CubeHeader) -> bool {
    NoiseFloorOrigin::of(header) == NoiseFloorOrigin::Estimated
}

/// Map of one frame, with the cells tested and detected by the detector.
pub(crate) fn range_doppler(
    transform: &RangeDoppler,
    detector: &Cfar,
    floor: NoiseFloorOrigin,
    frame: &CubeFrame,
) -> Result<RdmFrame, DspError> {
    let values = transform.all_channels(frame)?;
    let power = sum_over_channels(&values, transform.cells());
    let assumed_floor = assumed_floor(floor, &power);
    let mut mask = detector.mask(&power, assumed_floor.unwrap_or(0.0));
    if transform.division().multiplexing == Multiplexing::Ddm {
        keep_true_folds(transform, &frame.samples, &values, &mut mask);
    }
    Ok(RdmFrame {
        index: frame.index,
        time_s: frame.time_s,
        values,
        detections: mask.iter().filter(|m| **m == cfar::DETECTED).count() as u64,
        cells: mask.iter().filter(|m| **m != cfar::UNTESTED).count() as u64,
        mask,
        assumed_floor,
    })
}

/// Floor assumed for a noise-free map, 60 dB below its peak (`docs/scenes.md`, `[noise]`).
fn assumed_floor(floor: NoiseFloorOrigin, power: &[f64]) -> Option<f64> {
    let peak = power.iter().copied().fold(0.0, f64::max);
    (floor == NoiseFloorOrigin::Assumed).then(|| peak * power_from_db(-FLOOR_BELOW_PEAK_DB))
}
