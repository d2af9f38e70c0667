//! Sidelobes: the largest share of an echo's power that its windows leak into other cells of the map.
//!
//! A tone between cells leaves W(d − δ)/W(δ) of its own cell's value in a cell d away, over all offsets δ up
//! to half a cell. Two further effects leave power far from it:
//!
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
        Self {
            doppler: worst_shares(doppler, bands, band_cycles(&division, 1)),
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
    let mut spectrum: Vec<num_complex::Complex64> = taper.iter().map(|w| (*w).into()).collect();
    spectrum.resize(length, num_complex::Complex64::ZERO);
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
