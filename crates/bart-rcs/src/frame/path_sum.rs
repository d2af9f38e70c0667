//! Scattering amplitude from path records, by definition.

use crate::bodies::body_gains::BodyGains;
use crate::bodies::motion::Motion;
use artifact::paths::{Amplitude, Path};
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Position and time at which paths are summed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathView {
    /// Position p_t of the transmitter.
    pub transmitter_m: DVec3,
    /// Position p_r of the receiver.
    pub receiver_m: DVec3,
    /// Point to which R_t and R_r lead.
    pub origin_m: DVec3,
    /// Time after the frame's first sample.
    pub seconds: f64,
    /// Centre frequency f_c of the amplitudes and slopes.
    pub centre_frequency_hz: f64,
}

/// Part of paths that a radar receives.
#[derive(Clone, Copy)]
pub(crate) struct Reception<'a> {
    /// Polarization, received and transmitted, as indices of an amplitude.
    pub(crate) element: (usize, usize),
    /// Gains of the radar's antennas.
    pub(crate) gains: &'a BodyGains,
}

/// S = Σ a(f)·R_tR_r/(L₁L₂)·e^{−jk(L₁+L₂−R_t−R_r)} with a(f) = a + (f − f_c)·a′, metres, 2 × 2; paths that
/// represent a part of the frame are weighted by their share at that time.
pub fn scattering_of_paths<'a>(
    paths: impl IntoIterator<Item = &'a Path>,
    view: &PathView,
    frequency_hz: f64,
) -> Amplitude {
    let mut total = Amplitude::default();
    for path in paths {
        let factor = view.factor(path, frequency_hz);
        for (p, row) in total.iter_mut().enumerate() {
            for (q, sum) in row.iter_mut().enumerate() {
                let slope = path.slope_m_per_hz[p][q] * (frequency_hz - view.centre_frequency_hz);
                *sum += (path.amplitude_m[p][q] + slope) * factor;
            }
        }
    }
    total
}

/// One element of [`scattering_of_paths`], with paths weighted by gains, at equidistant frequencies: one
/// rotation per path leads from each to the next.
///
/// Runs of paths are summed in order, so the result is bit-identical for any number of threads.
pub(crate) fn element_over_band(
    paths: &[Path],
    view: &PathView,
    hearing: Reception<'_>,
    frequencies_hz: &[f64],
) -> Vec<Complex64> {
    const PATHS_PER_RUN: usize = 4096;
    let (Some(&first_hz), Some(&last_hz)) = (frequencies_hz.first(), frequencies_hz.last()) else {
        return Vec::new();
    };
    let (p, q) = hearing.element;
    let step_hz = (last_hz - first_hz) / (frequencies_hz.len() - 1).max(1) as f64;
    let zero = || vec![Complex64::ZERO; frequencies_hz.len()];
    let of_run = |run: &[Path]| {
        let mut sums = zero();
        for path in run {
            let (spread, length_m) = view.spread_and_length_m(path);
            let mut factor = Complex64::from_polar(
                hearing.gains.of_path(path) * spread,
                -wavenumber_per_m(first_hz) * length_m,
            );
            let turn = Complex64::cis(-wavenumber_per_m(step_hz) * length_m);
            for (sum, f) in sums.iter_mut().zip(frequencies_hz) {
                let slope = path.slope_m_per_hz[p][q] * (f - view.centre_frequency_hz);
                *sum += (path.amplitude_m[p][q] + slope) * factor;
                factor *= turn;
            }
        }
        sums
    };
    let runs: Vec<Vec<Complex64>> = paths.par_chunks(PATHS_PER_RUN).map(of_run).collect();
    runs.iter().fold(zero(), |sums, run| sums.iter().zip(run).map(|(a, b)| a + b).collect())
}

fn wavenumber_per_m(frequency_hz: f64) -> f64 {
    TAU * frequency_hz / SPEED_OF_LIGHT_MPS
}

/// Apparent points x_a and x_b some `seconds` after the frame's first sample; for a wheel those of its hub.
pub(crate) fn apparent_m(path: &Path, seconds: f64) -> [DVec3; 2] {
    moved_to(path, seconds).map(|(at_m, _)| at_m)
}

/// Apparent points x_a and x_b with their velocities some `seconds` after the frame's first sample.
pub(crate) fn moved_to(path: &Path, seconds: f64) -> [(DVec3, DVec3); 2] {
    let Path { apparent_tx_m, apparent_tx_mps, apparent_rx_m, apparent_rx_mps, curve, .. } = path;
    let after = |at_m: &[f64; 3], mps: &[f64; 3], mps2: [f64; 3]| {
        Motion::from_arrays(*mps, mps2).after(DVec3::from_array(*at_m), seconds)
    };
    [
        after(apparent_tx_m, apparent_tx_mps, curve.apparent_tx_mps2),
        after(apparent_rx_m, apparent_rx_mps, curve.apparent_rx_mps2),
    ]
}

impl PathView {
    fn factor(&self, path: &Path, frequency_hz: f64) -> Complex64 {
        let (spread, length_m) = self.spread_and_length_m(path);
        Complex64::from_polar(spread, -wavenumber_per_m(frequency_hz) * length_m)
    }

    /// Positions of both ends.
    pub(crate) fn ends_m(&self) -> [[f64; 3]; 2] {
        [self.transmitter_m.to_array(), self.receiver_m.to_array()]
    }

    /// Factor R_tR_r/(L₁L₂) times the path's share at that time, and length L₁ + L₂ − R_t − R_r.
    pub(crate) fn spread_and_length_m(&self, path: &Path) -> (f64, f64) {
        let [from_tx_m, from_rx_m] = apparent_m(path, self.seconds);
        let (l1, l2) = (from_tx_m.distance(self.transmitter_m), from_rx_m.distance(self.receiver_m));
        let (r_t, r_r) =
            (self.origin_m.distance(self.transmitter_m), self.origin_m.distance(self.receiver_m));
        let share = path.curve.share(self.seconds, self.ends_m());
        (share * (r_t * r_r / (l1 * l2)), l1 + l2 - r_t - r_r)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_by_turns_is_that_of_every_frequency() {
        let path = |i: u32| {
            let at = |step: f64| (f64::from(i) * step).fract();
            let apparent_m = [20.0 * at(0.618_034), 25.0 + 30.0 * at(0.414_214), 3.0 * at(0.732_051)];
            Path {
                order: 1,
                apparent_tx_m: apparent_m,
                apparent_tx_mps: [0.0, -10.0 * at(0.3), 0.0],
                apparent_rx_m: apparent_m.map(|x| x + 0.1),
                apparent_rx_mps: [1.0, -10.0, 0.0],
                amplitude_m: [[Complex64::from_polar(1.0, 6.0 * at(0.236_068)); 2]; 2],
                slope_m_per_hz: [[Complex64::new(1e-10 * at(0.5), -2e-10); 2]; 2],
                ..Path::default()
            }
        };
        let paths: Vec<Path> = (0..9000).map(path).collect();
        let view = PathView {
            transmitter_m: DVec3::Z * 6.0,
            receiver_m: DVec3::new(0.1, 0.0, 6.0),
            origin_m: DVec3::Y,
            seconds: 3e-3,
            centre_frequency_hz: 77e9,
        };
        let frequencies: Vec<f64> = (0..24).map(|i| 76.5e9 + 4e7 * f64::from(i)).collect();
        let alike = BodyGains::default();
        let hearing = |element| Reception { element, gains: &alike };
        let got = element_over_band(&paths, &view, hearing((0, 1)), &frequencies);
        for (value, f) in got.iter().zip(&frequencies) {
            let exact = scattering_of_paths(&paths, &view, *f)[0][1];
            // Phases of k·120 m, rounded at ε, in a sum of amplitudes of 0.002 of 9,000 paths.
            let allowed = 9000.0 * 0.002 * 4.0 * 1613.0 * 120.0 * f64::EPSILON;
            assert!((value - exact).norm() < allowed, "{:e}", (value - exact).norm());
        }
        assert!(element_over_band(&paths, &view, hearing((0, 0)), &[]).is_empty());
    }
}
