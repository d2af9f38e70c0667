//! Isolation of an echo: the effect of others on its maximum-likelihood estimates, relative to the Cramér–Rao
//! bound.
//!
//! The likelihood's score of a parameter is the samples' correlation with the echo's slope, ∂s/∂θ without the
//! part that its amplitude absorbs. Another echo of energy E over the noise (|a|²/σ² times all samples of all
//! channels), whose correlation with the slope of unit length is h, shifts the estimate by up to √(2E)·h
//! standard errors of the bound, E·h² in the mean square over its phase. Along range and velocity h falls
//! with distance like the slope of the Dirichlet kernel, three times the power that leaks into the peak's own
//! cell; over the array it is the other's beam towards the echo's direction.
//!
//! There are two tests. [`Neighbours`] adds up this error over all other peaks of the map. Echoes under the
//! same peak are not among them: [`single_echo_fits`] searches for a second echo in the residual of the
//! samples after subtracting the fitted one.

use crate::detection::peaks::Peak;
use crate::direction::angle::{Direction, VirtualArray};
use crate::estimation::point_echo::{Block, PointEcho, blocks};
use crate::plan::Plan;
use artifact::Radar;
use artifact::rdm::RdmFrame;
use num_complex::{Complex32, Complex64};
use std::f64::consts::{PI, TAU};

/// Mean square error that other echoes may add, in squares of the bound: 0.4 dB.
const MOST_BIAS: f64 = 0.1;

/// Peaks of a map, with what is needed to compute their effect on one of them.
pub(crate) struct Neighbours<'a> {
    /// Radar and settings.
    pub(crate) plan: &'a Plan,
    /// Map that contains the peaks.
    pub(crate) map: &'a RdmFrame,
    /// All peaks.
    pub(crate) peaks: &'a [Peak],
    /// Noise power of a cell of the map, summed over channels.
    pub(crate) noise: f64,
}

impl Neighbours<'_> {
    /// Whether the other peaks leave the estimates of the echo with this peak within 0.4 dB of their bound.
    pub(crate) fn bias_is_negligible(&self, peak: &Peak, echo: PointEcho) -> bool {
        let beams = SteeringVector::new(&self.plan.array, echo);
        let mut bias = [0.0; PARAMETERS];
        for other in self.peaks.iter().filter(|other| (other.row, other.column) != (peak.row, peak.column)) {
            // As the echo's own time-division slots see it: compensated for the echo's velocity, not for its
            // own.
            let cell = [other.row, other.column];
            let snapshot = self.plan.array.snapshot(self.map, cell, echo.radial_velocity_mps);
            // Noise bandwidth: the deficit of a cell's power relative to an unwindowed one's signal-to-noise
            // ratio.
            let channels = self.plan.array.division().map_channels as f64;
            let energy = self.plan.thresholds.bandwidth_cells * channels / self.noise;
            let added = beams.correlations(&snapshot).map(|h| energy * h);
            let [rows, columns] = self.along(peak, other);
            let shares = [
                columns.slope * rows.value,
                columns.value * rows.slope,
                columns.value * rows.value,
                columns.value * rows.value,
            ];
            (0..PARAMETERS).for_each(|i| bias[i] += added[i] * shares[i]);
        }
        bias.iter().all(|bias| *bias <= MOST_BIAS)
    }

    fn along(&self, a: &Peak, b: &Peak) -> [ToneCorrelation; 2] {
        let waveform = &self.plan.radar.waveform;
        [
            ToneCorrelation::of(a.fine_row - b.fine_row, waveform.chirps),
            ToneCorrelation::of(a.fine_column - b.fine_column, waveform.samples),
        ]
    }
}

/// Range, velocity, direction cosines along right and up.
const PARAMETERS: usize = 4;

/// Maximum |correlation|² of a tone with another along one axis, and with the other's unit-length slope.
struct ToneCorrelation {
    value: f64,
    slope: f64,
}

impl ToneCorrelation {
    /// Envelopes of the Dirichlet kernel sin πx/(N sin πx/N), and of its slope normalised by π/√3, the
    /// slope's length.
    fn of(cells: f64, count: u32) -> Self {
        let away = f64::from(count) * (PI * cells / f64::from(count)).sin().abs();
        let [value, slope] =
            [1.0, 3f64.sqrt() * (1.0 + 1.0 / away)].map(|most: f64| (most / away).powi(2).min(1.0));
        Self { value, slope }
    }
}

/// An echo over the array, with unit length, and its derivatives with respect to direction.
struct SteeringVector {
    of_parameters: [Vec<Complex64>; PARAMETERS],
}

impl SteeringVector {
    fn new(array: &VirtualArray, echo: PointEcho) -> Self {
        let steering = array.steering(echo.direction, echo.range_m);
        let slopes = array.excess_slopes_m(echo.direction, echo.range_m);
        let count = steering.len() as f64;
        let own: Vec<Complex64> = steering.iter().map(|turn| turn / count.sqrt()).collect();
        let [right, up] = [0, 1].map(|axis: usize| {
            let mean = slopes.iter().map(|s| s[axis]).sum::<f64>() / count;
            let length = slopes.iter().map(|s| (s[axis] - mean).powi(2)).sum::<f64>().sqrt();
            // A direction cannot be wrong along an axis without extent.
            let weight = |s: &[f64; 2]| if length > 0.0 { (s[axis] - mean) / length } else { 0.0 };
            steering.iter().zip(&slopes).map(|(turn, s)| turn * weight(s)).collect()
        });
        Self { of_parameters: [own.clone(), own, right, up] }
    }

    fn correlations(&self, snapshot: &[Complex64]) -> [f64; PARAMETERS] {
        let with = |beam: &Vec<Complex64>| {
            beam.iter().zip(snapshot).map(|(b, v)| b * v).sum::<Complex64>().norm_sqr()
        };
        [0, 1, 2, 3].map(|i: usize| with(&self.of_parameters[i]))
    }
}

/// Cells searched on each side of the echo: two under one peak lie within a window's main lobe.
const NEAR_CELLS: usize = 2;
/// Probability that noise alone is taken for a second echo.
const FALSE_SECOND_RATE: f64 = 1e-3;
/// Share of the first echo's power, −50 dB, below which a second is indistinguishable from model errors; it
/// shifts a range by at most 1/600 cell (√3/π·10^−2.5).
const MODEL_ERROR: f64 = 1e-5;

/// Whether nothing like a second echo remains near a fitted one, in any direction; `noise` is that of one
/// sample.
pub(crate) fn single_echo_fits(plan: &Plan, samples: &[Complex32], echo: &PointEcho, noise: f64) -> bool {
    let array = &plan.array;
    let mut left = blocks(plan, samples, echo);
    let weight: f64 = left.iter().map(|b| b.weight).sum();
    let amplitude = left.iter().map(|b| b.sum).sum::<Complex64>() / weight;
    left.iter_mut().for_each(|b| b.sum -= amplitude * b.weight);
    let channels = array.division().pairs();
    let cells = (2 * NEAR_CELLS + 1).pow(2);
    let believed = second_threshold(array, cells * channels) * noise * weight;
    let most = believed.max(MODEL_ERROR * amplitude.norm_sqr() * weight * weight);
    let steering = array.steering(echo.direction, echo.range_m);
    let of_channel: Vec<Vec<Complex64>> =
        left.chunks(left.len() / channels).map(|b| near_cells(&plan.radar, b)).collect();
    (0..cells).all(|cell| {
        // The blocks' phases are aligned to the echo's direction; this is undone so that the beam can search
        // around it.
        let snapshot: Vec<Complex64> =
            of_channel.iter().zip(&steering).map(|(c, turn)| c[cell] * turn.conj()).collect();
        let direction: Direction = array.fft_direction(std::slice::from_ref(&snapshot), echo.range_m);
        array.beam(&snapshot, &array.steering(direction, echo.range_m)).norm_sqr() <= most
    })
}

/// Threshold t that solves M·t^axes·e^{−t} = the rate: powers of M independent cells and beams, and between
/// beams the maximum of a field along each axis.
fn second_threshold(array: &VirtualArray, independent: usize) -> f64 {
    let axes = array.beams().into_iter().filter(|beam| beam.is_finite()).count();
    let next = |t: f64, _| (independent as f64 * t.powi(axes as i32) / FALSE_SECOND_RATE).ln();
    // Each step removes four fifths of the error.
    (0..20).fold(14.0, next)
}

/// Sums of one channel's blocks, shifted by −2…2 cells of velocity and of range.
fn near_cells(radar: &Radar, blocks: &[Block]) -> Vec<Complex64> {
    let waveform = &radar.waveform;
    let frame_s = f64::from(waveform.chirps) * radar.repetition_interval_s();
    let sweep_s = f64::from(waveform.samples) / waveform.sample_rate_hz;
    let side = 2 * NEAR_CELLS + 1;
    let mut cells = vec![Complex64::ZERO; side * side];
    for block in blocks {
        let rows = turns(block.frame_s / frame_s);
        let columns = turns(block.sweep_s / sweep_s);
        for (row, sums) in rows.iter().zip(cells.chunks_exact_mut(side)) {
            let turned = block.sum * row;
            sums.iter_mut().zip(&columns).for_each(|(sum, column)| *sum += turned * column);
        }
    }
    cells
}

/// Phase factors e^{−j2πn·cycles} for n = −2…2.
fn turns(cycles: f64) -> [Complex64; 2 * NEAR_CELLS + 1] {
    let one = Complex64::from_polar(1.0, -TAU * cycles);
    let two = one * one;
    [two.conj(), one.conj(), Complex64::ONE, one, two]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn envelopes_lie_above_the_kernel_and_its_slope_at_every_distance() {
        let count = 32;
        let kernel = |x: f64| {
            let tone = |n: i32| Complex64::from_polar(1.0 / 32.0, TAU * x * f64::from(n) / 32.0);
            let middle = 15.5;
            let length = (0..32).map(|n| (f64::from(n) - middle).powi(2) / 32.0).sum::<f64>().sqrt();
            let value: Complex64 = (0..32).map(tone).sum();
            let slope: Complex64 = (0..32).map(|n| tone(n) * ((f64::from(n) - middle) / length)).sum();
            [value.norm_sqr(), slope.norm_sqr()]
        };
        for step in 1..16 * 50 {
            let cells = f64::from(step) / 50.0;
            let ([value, slope], most) = (kernel(cells), ToneCorrelation::of(cells, count));
            // The slope's length is π/√3·√(1 − 1/N²) of a cell.
            assert!(
                value <= most.value + 1e-12 && slope <= most.slope * (1.0 + 1e-3) + 1e-12,
                "{cells}: {slope}"
            );
            assert!(value + slope <= 1.0 + 1e-12, "two parts of one tone");
        }
    }
}
