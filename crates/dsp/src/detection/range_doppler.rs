//! Range-Doppler map: window, FFT over samples, window, FFT over chirps, for every transmit–receive pair, and
//! what its detector finds.

use crate::detection::cfar::{self, Cfar};
use crate::detection::empty_band::keep_true_folds;
use crate::error::DspError;
use crate::spectrum::map_transform::RangeDoppler;
use crate::spectrum::noncoherent::{FLOOR_BELOW_PEAK_DB, sum_over_channels};
use artifact::cube::CubeFrame;
use artifact::radar::Multiplexing;
use artifact::rdm::RdmFrame;
use artifact::settings::Noise;
use artifact::units::power_from_db;

/// The map of one frame, with the cells that a detector tested and those it found.
pub(crate) fn range_doppler(
    transform: &RangeDoppler,
    detector: &Cfar,
    noise: Noise,
    frame: &CubeFrame,
) -> Result<RdmFrame, DspError> {
    let values = transform.all_channels(&frame.samples)?;
    let power = sum_over_channels(&values, transform.cells());
    let assumed_floor = assumed_floor(noise, &power);
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
fn assumed_floor(noise: Noise, power: &[f64]) -> Option<f64> {
    let peak = power.iter().copied().fold(0.0, f64::max);
    matches!(noise, Noise::Absent).then(|| peak * power_from_db(-FLOOR_BELOW_PEAK_DB))
}
