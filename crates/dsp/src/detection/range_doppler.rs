//! Range-Doppler map: window, FFT over samples, window, FFT over chirps, for every transmit–receive pair, and
//! what its detector finds.

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

/// Origin of the noise that thresholds stand on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Floor {
    /// The map's own cells.
    Estimated,
    /// Nothing in the map: a floor below its peak stands in.
    Assumed,
}

impl Floor {
    /// Noise of samples that a converter counted is always there, whatever their scene says.
    pub(crate) fn of(header: &CubeHeader) -> Self {
        match (header.noise, header.unit) {
            (Noise::Absent, SampleUnit::RootWatts) => Self::Assumed,
            _ => Self::Estimated,
        }
    }
}

/// Whether maps of these cubes have noise to estimate: else a floor below their peak stands in, and with it
/// stand thresholds and levels over noise.
pub fn has_noise(header: &CubeHeader) -> bool {
    Floor::of(header) == Floor::Estimated
}

/// The map of one frame, with the cells that a detector tested and those it found.
pub(crate) fn range_doppler(
    transform: &RangeDoppler,
    detector: &Cfar,
    floor: Floor,
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

/// A noise-free map has no noise to estimate: a floor 60 dB below its peak stands in (`docs/scenes.md`,
/// `[noise]`).
fn assumed_floor(floor: Floor, power: &[f64]) -> Option<f64> {
    let peak = power.iter().copied().fold(0.0, f64::max);
    (floor == Floor::Assumed).then(|| peak * power_from_db(-FLOOR_BELOW_PEAK_DB))
}
