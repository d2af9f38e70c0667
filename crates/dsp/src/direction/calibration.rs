//! Errors of the virtual array's channels, measured on a reflector at a known position.
//!
//! A channel's value of its echo, without the phase of the exact two-way path, is the channel's own gain and
//! phase, up to one common factor. White noise shifts a phase by 1/√(2·SNR) rad of the channel's cell; frames
//! are averaged.

use crate::direction::angle::{Direction, VirtualArray};
use crate::error::DspError;
use crate::spectrum::axes::Axes;
use crate::spectrum::noncoherent::PowerLevels;
use artifact::rdm::RdmFrame;
use artifact::units::{db_from_power, power_from_db};
use glam::DVec3;
use ndarray::ArrayView2;
use num_complex::Complex64;

/// Minimum SNR of the weakest channel's cell, dB: 4° of phase.
const LEAST_SNR_DB: f64 = 20.0;
/// Range cells searched on either side of the known one: feed lines are up to half a cell long.
const REACH: usize = 2;

/// Gain and phase of each transmit–receive pair, tx·N_rx + rx, relative to an ideal one; their mean power is
/// 1, their sum is real.
///
/// The reflector is at rest at `position_m`, world metres. The array's calibration is not used.
pub(crate) fn channel_errors(
    array: &VirtualArray,
    levels: &PowerLevels,
    map: &RdmFrame,
    position_m: [f64; 3],
) -> Result<Vec<Complex64>, DspError> {
    let away_m = DVec3::from(position_m) - array.position_m();
    let range_m = away_m.length();
    let cell = strongest_at_rest(array.cells(), levels.power(), range_m)?;
    let [right, up, _] = array.axes();
    let direction = Direction { right: away_m.dot(right) / range_m, up: Some(away_m.dot(up) / range_m) };
    let snapshot = array.uncalibrated(map, cell, 0.0).0;
    let weakest = snapshot.iter().map(|value| value.norm_sqr()).fold(f64::INFINITY, f64::min);
    let noise = levels.noise();
    if weakest.is_nan() || weakest <= power_from_db(LEAST_SNR_DB) * noise {
        let snr_db = db_from_power(weakest / noise);
        return Err(DspError::WeakReflector { range_m, snr_db, least_db: LEAST_SNR_DB });
    }
    let steering = array.steering(direction, range_m);
    Ok(normalized(snapshot.iter().zip(steering).map(|(value, turn)| value * turn).collect()))
}

/// Mean of several frames' errors, each of which is known up to a common factor: a frame is rotated in phase
/// to the first by Σ e·conj e₁, which has the magnitude of both whatever the sum of the errors.
pub fn mean_errors(frames: &[Vec<Complex64>]) -> Vec<Complex64> {
    let Some(first) = frames.first() else { return vec![] };
    let mut sums = vec![Complex64::ZERO; first.len()];
    for errors in frames {
        let apart: Complex64 = errors.iter().zip(first).map(|(own, first)| own * first.conj()).sum();
        let turn = Complex64::cis(-apart.arg());
        sums.iter_mut().zip(errors).for_each(|(sum, error)| *sum += error * turn);
    }
    normalized(sums)
}

/// Row and column of the strongest cell at zero velocity near a range.
fn strongest_at_rest(axes: &Axes, power: ArrayView2<f64>, range_m: f64) -> Result<[usize; 2], DspError> {
    let (row, columns) = (axes.rows / 2, axes.columns);
    let expected = axes.column_at(range_m).round();
    // A NaN range is rejected as well.
    if !(range_m > 0.0 && expected < columns as f64) {
        return Err(DspError::ReflectorRange { range_m, limit_m: axes.range_max_m });
    }
    let near = (expected as usize).saturating_sub(REACH)..=(expected as usize + REACH).min(columns - 1);
    let best = near.fold(expected as usize, |a, b| if power[(row, b)] > power[(row, a)] { b } else { a });
    Ok([row, best])
}

fn normalized(errors: Vec<Complex64>) -> Vec<Complex64> {
    let power = errors.iter().map(|error| error.norm_sqr()).sum::<f64>() / errors.len().max(1) as f64;
    let sum: Complex64 = errors.iter().sum();
    let common = Complex64::from_polar(power.sqrt().max(f64::MIN_POSITIVE), sum.arg());
    errors.into_iter().map(|error| error / common).collect()
}
