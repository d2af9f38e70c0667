//! Sidelobes: the largest share of an echo's power that its windows leak into other cells of the map.
//!
//! A tone between cells leaves W(d − δ)/W(δ) of its own cell's value in a cell d away, over all offsets δ up
//! to half a cell. Three further effects leave power far from it:
//!
//! - with staggered chirps the rows of a map are the spectrum of chirps at unequal times, which leaves images
//!   of an echo at the multiples of 1/P of the span, P being the number of delays;
//! - with Doppler division a cell sums a band of every transmitter, and the sidelobes of all transmitters add
//!   up in each of them, in phase at worst. Their main lobes are the folds of the echo, which the empty band
//!   resolves (`empty_band.rs`);
//! - for real samples the echo has its conjugate at the opposite Doppler and range, outside the map, with
//!   sidelobes inside it.

use crate::detection::images::conjugate_row;
use crate::spectrum::division::Division;
use crate::spectrum::doppler_bands::band_cycles;
use crate::spectrum::window::fine_transform;
use artifact::Radar;
use artifact::radar::{Multiplexing, Sampling};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Shares of power by distance in cells.
pub(crate) struct Leakage {
    doppler: AxisLeakage,
    range: AxisLeakage,
    /// Whether echoes have conjugates.
    has_images: bool,
}

/// Rounding of windows and transforms: levels farther below a peak than single precision carries are
/// indistinguishable (2⁻²⁴ of the amplitude, −144 dB).
const FLOOR: f64 = 3.6e-15;
/// Offsets tried between two cells for the worst leakage.
const OFFSETS: i32 = 8;

impl Leakage {
    /// Leakage in maps of a radar made with these windows.
    pub(crate) fn new(radar: &Radar, doppler: &[f64], range: &[f64]) -> Self {
        let division = Division::of(radar);
        let bands = match division.multiplexing {
            Multiplexing::Ddm => division.transmitters,
            Multiplexing::Simultaneous | Multiplexing::Tdm | Multiplexing::Bpm => 1,
        };
        let has_images = radar.waveform.sampling == Sampling::Real;
        let of_rows = || AxisLeakage::of(doppler, bands, band_cycles(&division, 1));
        let is_staggered = bands == 1 && !radar.schedule.is_uniform();
        Self {
            doppler: if is_staggered { AxisLeakage::of_staggered(radar, doppler) } else { of_rows() },
            range: AxisLeakage::of(range, 1, 0.0),
            has_images,
        }
    }

    /// Maximum share of the power of one cell, [doppler, range], in another.
    pub(crate) fn share(&self, from: [usize; 2], at: [usize; 2]) -> f64 {
        self.with_conjugate(self.between(from, at), from, at)
    }

    /// [`Self::share`] in a cell beyond the main lobe of a peak that lies at `peak` between cells, next to
    /// `from`; `None` within the lobe.
    pub(crate) fn share_beyond_lobe(&self, from: [usize; 2], peak: [f64; 2], at: [usize; 2]) -> Option<f64> {
        let axes = [&self.doppler, &self.range];
        let away = [0, 1].map(|i: usize| peak[i] - at[i] as f64);
        if axes.iter().zip(away).all(|(axis, cells)| axis.is_within_lobe(cells)) {
            return None;
        }
        let along = |i: usize| axes[i].shares_at(away[i])[from[i].abs_diff(at[i])];
        Some(self.with_conjugate(along(0) * along(1), from, at))
    }

    /// Adds the share of the echo's conjugate, if it has one: in phase, the worst case.
    fn with_conjugate(&self, direct: f64, from: [usize; 2], at: [usize; 2]) -> f64 {
        if !self.has_images {
            return direct;
        }
        let (rows, columns) = (self.doppler.shares.len(), self.range.shares.len());
        let conjugate = [conjugate_row(from[0], rows), (columns - from[1]) % columns];
        (direct.sqrt() + self.between(conjugate, at).sqrt()).powi(2)
    }

    fn between(&self, from: [usize; 2], at: [usize; 2]) -> f64 {
        self.doppler.shares[from[0].abs_diff(at[0])] * self.range.shares[from[1].abs_diff(at[1])]
    }
}

/// Maximum shares of a peak's power that a window leaks along an axis, by distance in cells, over all offsets
/// of the tone from its cell.
struct AxisLeakage {
    shares: Vec<f64>,
    /// Shares over those offsets alone that put a cell beyond the main lobe.
    sidelobes: Vec<f64>,
    /// Half width of the main lobe, cells.
    lobe_cells: f64,
}

impl AxisLeakage {
    /// Leakage under a window with `bands` bands, each `band_cycles` of the axis behind the one before.
    fn of(taper: &[f64], bands: usize, band_cycles: f64) -> Self {
        let fine = fine_response(taper);
        let band_steps = (band_cycles * fine.len() as f64).round() as i64;
        let lobe = main_lobe(&fine);
        let response = Sidelobes { lobe, fine: &fine, band_steps };
        let share = |steps: i64, offset: i64| {
            response.over_bands(steps, bands) / response.at(offset).max(f64::MIN_POSITIVE)
        };
        Self::worst(taper.len(), lobe, share)
    }

    /// Leakage of staggered chirps: the largest over all transmitters, whose chirps may have other delays. An
    /// echo is assumed to be as fast as the map shows it.
    fn of_staggered(radar: &Radar, taper: &[f64]) -> Self {
        let lobe = main_lobe(&fine_response(taper));
        let responses: Vec<Vec<f64>> =
            (0..radar.array.tx_m.len()).map(|tx| staggered_response(radar, tx, taper)).collect();
        let share = |steps: i64, offset: i64| {
            let of = |fine: &Vec<f64>| {
                let [there, here] = [steps, offset].map(|steps| fine[steps.unsigned_abs() as usize]);
                there / here.max(f64::MIN_POSITIVE)
            };
            responses.iter().map(of).fold(0.0, f64::max)
        };
        Self::worst(taper.len(), lobe, share)
    }

    /// Maxima of a share, given the steps from the tone to the cell, and to its own cell.
    fn worst(cells: usize, lobe: i64, share: impl Fn(i64, i64) -> f64) -> Self {
        let circle = cells as i64 * i64::from(OFFSETS);
        let over = |lag: usize, nearest: i64| {
            let half = i64::from(OFFSETS / 2);
            let steps = (-half..=half).map(|offset| (lag as i64 * i64::from(OFFSETS) - offset, offset));
            let far = steps.filter(|(steps, _)| around(*steps, circle) >= nearest);
            far.map(|(steps, offset)| share(steps, offset)).fold(FLOOR, f64::max).min(1.0)
        };
        Self {
            shares: (0..cells).map(|lag| over(lag, 0)).collect(),
            sidelobes: (0..cells).map(|lag| over(lag, lobe)).collect(),
            lobe_cells: lobe as f64 / f64::from(OFFSETS),
        }
    }

    fn is_within_lobe(&self, cells: f64) -> bool {
        let cells = cells.abs();
        cells.min(self.shares.len() as f64 - cells) < self.lobe_cells
    }

    /// Shares of a cell this far from the tone: those of the sidelobes beyond the main lobe.
    fn shares_at(&self, cells: f64) -> &[f64] {
        if self.is_within_lobe(cells) { &self.shares } else { &self.sidelobes }
    }
}

/// Power |Σ w_m·e^{j2πd(m/N + δ_m/NT)}|²/N² of the chirps of one transmitter, δ_m after those of equal
/// intervals T, at d from 0 to N and half a cell, in steps of an eighth of a cell: a sum of one transform for
/// each delay.
fn staggered_response(radar: &Radar, tx: usize, taper: &[f64]) -> Vec<f64> {
    let (rows, per_cell) = (taper.len(), OFFSETS as usize);
    let length = rows * per_cell;
    let delays = radar.schedule.stagger_s.len().clamp(1, rows);
    let transform = rustfft::FftPlanner::new().plan_fft_inverse(length);
    let mut sums = vec![Complex64::ZERO; length + per_cell];
    for first in 0..delays {
        let mut spectrum = vec![Complex64::ZERO; length];
        (first..rows).step_by(delays).for_each(|m| spectrum[m] = taper[m].into());
        transform.process(&mut spectrum);
        let late_s = radar.chirp_start_s(tx, first) - radar.chirp_start_s(tx, 0);
        let late = late_s / radar.repetition_interval_s() - first as f64;
        for (step, sum) in sums.iter_mut().enumerate() {
            let turns = step as f64 * late / length as f64;
            *sum += spectrum[step % length] * Complex64::cis(TAU * turns);
        }
    }
    sums.iter().map(|sum| sum.norm_sqr() / (rows as f64).powi(2)).collect()
}

/// Response of a window in steps of a fraction of a cell.
struct Sidelobes<'a> {
    fine: &'a [f64],
    /// Steps to the first null.
    lobe: i64,
    /// Steps from band to band.
    band_steps: i64,
}

impl Sidelobes<'_> {
    fn at(&self, steps: i64) -> f64 {
        self.fine[steps.rem_euclid(self.fine.len() as i64) as usize]
    }

    /// Mean over the bands of a cell of what all transmitters leave in it: the full response of each band's
    /// own transmitter, the sidelobes of the others.
    fn over_bands(&self, steps: i64, bands: usize) -> f64 {
        if bands == 1 {
            return self.at(steps);
        }
        let most = bands as i64 - 1;
        let amplitude = |apart: i64| {
            let steps = steps + apart * self.band_steps;
            if apart == 0 || self.is_sidelobe(steps) { self.at(steps).sqrt() } else { 0.0 }
        };
        // Cumulative amplitudes from the farthest transmitter on; a band receives as many as there are bands.
        let added: Vec<f64> = std::iter::once(0.0)
            .chain((-most..=most).scan(0.0, |sum, apart| {
                *sum += amplitude(apart);
                Some(*sum)
            }))
            .collect();
        let of_bands = added.iter().zip(&added[bands..]).map(|(before, to)| (to - before).powi(2));
        of_bands.sum::<f64>() / bands as f64
    }

    fn is_sidelobe(&self, steps: i64) -> bool {
        around(steps, self.fine.len() as i64) > self.lobe
    }
}

/// Distance from 0 on a circle, the shorter way round.
fn around(steps: i64, circle: i64) -> i64 {
    let forwards = steps.rem_euclid(circle);
    forwards.min(circle - forwards)
}

/// Steps from the centre of a response to its first null.
fn main_lobe(fine: &[f64]) -> i64 {
    fine.windows(2).position(|pair| pair[1] > pair[0]).unwrap_or(fine.len()) as i64
}

/// Response in steps of an eighth of a cell.
fn fine_response(taper: &[f64]) -> Vec<f64> {
    let scale = (taper.len() as f64).powi(-2);
    fine_transform(taper, OFFSETS as usize).iter().map(|v| v.norm_sqr() * scale).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::window::taper;
    use artifact::settings::Window;
    use radar::aperture::Preset;
    use radar::paper;
    use std::f64::consts::PI;

    #[test]
    fn sidelobes_of_three_transmitters_in_phase_are_nine_times_those_of_one() {
        let window = taper(Window::Chebyshev(60.0), 256).unwrap();
        let [one, three] =
            [(1, 0.0), (3, 0.25)].map(|(bands, cycles)| AxisLeakage::of(&window, bands, cycles).shares);
        // Level of the sidelobes, far from the folds at 64, 128 and 192 cells.
        for lag in [20, 32, 40, 96, 100, 160] {
            let ratio = three[lag] / one[lag];
            assert!((4.0..11.0).contains(&ratio), "{lag} cells away: {ratio}");
        }
        // The folds' main lobes are left to the empty band.
        assert!(three[64] < 1e-4 && (three[1] / one[1] - 1.0).abs() < 0.02, "{} {}", three[64], three[1]);
    }

    /// Against the sum over the chirps' own times.
    #[test]
    fn staggered_chirps_leave_images_at_their_part_of_the_span() {
        let mut radar = paper::radar([0.0; 3], paper::waveform(64, 32), Preset::OneByOne.elements());
        radar.schedule.stagger_s = vec![0.0, 10e-6];
        let window = taper(Window::Hann, 32).unwrap();
        let interval_s = radar.repetition_interval_s();
        for (step, told) in staggered_response(&radar, 0, &window).into_iter().enumerate() {
            let turns = |m: usize| step as f64 / 8.0 / 32.0 * radar.chirp_start_s(0, m) / interval_s;
            let sum: Complex64 = (0..32).map(|m| Complex64::cis(TAU * turns(m)) * window[m] / 32.0).sum();
            assert!((told - sum.norm_sqr()).abs() < 1e-12, "{step}: {told}, {}", sum.norm_sqr());
        }
        let AxisLeakage { shares, .. } = AxisLeakage::of_staggered(&radar, &window);
        // |1 − e^{jπδ/T}|²/4 half a span away.
        let image = (1.0 - Complex64::cis(PI * 10e-6 / interval_s)).norm_sqr() / 4.0;
        assert!((shares[16] / image - 1.0).abs() < 0.3, "{} and {image}", shares[16]);
        assert!(shares[8] < 1e-3 * image, "{}", shares[8]);
    }

    #[test]
    fn a_conjugate_lies_on_the_other_side_of_both_zeros() {
        let hann = |length| AxisLeakage::of(&taper(Window::Hann, length).unwrap(), 1, 0.0);
        for rows in [15, 16] {
            let leakage = Leakage { doppler: hann(rows), range: hann(64), has_images: true };
            // Three cells above zero velocity, two from range 0: the conjugate is three below and two before.
            let image = leakage.share([rows / 2 + 3, 2], [rows / 2 - 3, 0]);
            assert!((image / hann(64).shares[2] - 1.0).abs() < 0.1, "{rows} rows: {image}");
        }
    }
}
