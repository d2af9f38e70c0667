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
use crate::spectrum::window::response;
use artifact::Radar;
use artifact::radar::{Multiplexing, Sampling};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Shares of power by distance in cells.
pub(crate) struct Leakage {
    doppler: Vec<f64>,
    range: Vec<f64>,
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
        let of_rows = || worst_shares(doppler, bands, band_cycles(&division, 1));
        let is_staggered = bands == 1 && !radar.schedule.is_uniform();
        Self {
            doppler: if is_staggered { worst_staggered_shares(radar, doppler) } else { of_rows() },
            range: worst_shares(range, 1, 0.0),
            has_images,
        }
    }

    /// Maximum share of the power of one cell, [doppler, range], in another.
    pub(crate) fn share(&self, from: [usize; 2], at: [usize; 2]) -> f64 {
        let direct = self.between(from, at);
        if !self.has_images {
            return direct;
        }
        let (rows, columns) = (self.doppler.len(), self.range.len());
        let conjugate = [conjugate_row(from[0], rows), (columns - from[1]) % columns];
        // Worst case: in phase.
        (direct.sqrt() + self.between(conjugate, at).sqrt()).powi(2)
    }

    fn between(&self, from: [usize; 2], at: [usize; 2]) -> f64 {
        self.doppler[from[0].abs_diff(at[0])] * self.range[from[1].abs_diff(at[1])]
    }
}

/// Maximum share of a peak's power that its window leaks into a cell at each distance, over all offsets of
/// the tone; for `bands` bands, each `band_cycles` of the axis behind the one before.
fn worst_shares(taper: &[f64], bands: usize, band_cycles: f64) -> Vec<f64> {
    let (length, per_cell) = (taper.len(), OFFSETS as usize);
    let fine = fine_response(taper);
    let band_steps = (band_cycles * fine.len() as f64).round() as i64;
    let sidelobes = Sidelobes { lobe: main_lobe(&fine), fine: &fine, band_steps };
    let worst = |lag: usize| {
        let offsets = -OFFSETS / 2..=OFFSETS / 2;
        let share = |offset: i32| {
            let offset = i64::from(offset);
            let own = sidelobes.at(offset).max(f64::MIN_POSITIVE);
            sidelobes.over_bands((lag * per_cell) as i64 - offset, bands) / own
        };
        offsets.map(share).fold(FLOOR, f64::max).min(1.0)
    };
    (0..length).map(worst).collect()
}

/// [`worst_shares`] of staggered chirps: the largest over all transmitters, whose chirps may have other
/// delays. An echo is assumed to be as fast as the map shows it.
fn worst_staggered_shares(radar: &Radar, taper: &[f64]) -> Vec<f64> {
    let rows = taper.len();
    let of_transmitter = |tx: usize| {
        let fine = staggered_response(radar, tx, taper);
        let at = |steps: i32| fine[steps.unsigned_abs() as usize];
        let worst = |row: usize| {
            let share = |offset: i32| at(row as i32 * OFFSETS - offset) / at(offset).max(f64::MIN_POSITIVE);
            (-OFFSETS / 2..=OFFSETS / 2).map(share).fold(FLOOR, f64::max).min(1.0)
        };
        (0..rows).map(worst).collect::<Vec<f64>>()
    };
    let larger = |a: Vec<f64>, b: Vec<f64>| a.into_iter().zip(b).map(|(a, b)| a.max(b)).collect();
    (0..radar.array.tx_m.len()).map(of_transmitter).fold(vec![FLOOR; rows], larger)
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
        let circle = self.fine.len() as i64;
        let around = steps.rem_euclid(circle);
        around.min(circle - around) > self.lobe
    }
}

/// Steps from the centre of a response to its first null.
fn main_lobe(fine: &[f64]) -> i64 {
    fine.windows(2).position(|pair| pair[1] > pair[0]).unwrap_or(fine.len()) as i64
}

/// Response in steps of an eighth of a cell.
fn fine_response(taper: &[f64]) -> Vec<f64> {
    let length = taper.len() * OFFSETS as usize;
    let mut spectrum: Vec<Complex64> = taper.iter().map(|w| (*w).into()).collect();
    spectrum.resize(length, Complex64::ZERO);
    rustfft::FftPlanner::new().plan_fft_forward(length).process(&mut spectrum);
    let scale = (taper.len() as f64).powi(-2);
    debug_assert!((spectrum[0].norm_sqr() * scale - response(taper, 0.0)).abs() < 1e-9);
    spectrum.iter().map(|v| v.norm_sqr() * scale).collect()
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
        let (one, three) = (worst_shares(&window, 1, 0.0), worst_shares(&window, 3, 0.25));
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
        let shares = worst_staggered_shares(&radar, &window);
        // |1 − e^{jπδ/T}|²/4 half a span away.
        let image = (1.0 - Complex64::cis(PI * 10e-6 / interval_s)).norm_sqr() / 4.0;
        assert!((shares[16] / image - 1.0).abs() < 0.3, "{} and {image}", shares[16]);
        assert!(shares[8] < 1e-3 * image, "{}", shares[8]);
    }

    #[test]
    fn a_conjugate_lies_on_the_other_side_of_both_zeros() {
        let hann = |length| worst_shares(&taper(Window::Hann, length).unwrap(), 1, 0.0);
        for rows in [15, 16] {
            let leakage = Leakage { doppler: hann(rows), range: hann(64), has_images: true };
            // Three cells above zero velocity, two from range 0: the conjugate is three below and two before.
            let image = leakage.share([rows / 2 + 3, 2], [rows / 2 - 3, 0]);
            assert!((image / hann(64)[2] - 1.0).abs() < 0.1, "{rows} rows: {image}");
        }
    }
}
