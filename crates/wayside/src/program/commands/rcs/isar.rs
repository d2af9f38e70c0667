//! Range profiles and inverse synthetic aperture images of a table S(frequency, azimuth).
//!
//! A scatterer at x has S ∝ e^{+2jk r̂·x}: the transform over frequency gathers it at its range −r̂·x, and
//! the sum over azimuths of each profile's value there at its place.

use crate::program::commands::rcs::sampling::centre;
use artifact::units::SPEED_OF_LIGHT_MPS;
use ndarray::{Array2, ArrayView2};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Power over a square about the origin, `[ahead, left]`, body axes.
#[derive(Debug, Clone)]
pub(super) struct Image {
    pub(super) power_m2: Array2<f64>,
    pub(super) sum: Sum,
}

/// Sum over azimuths of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sum {
    /// Sum of values with their phases: neighbours are dense enough.
    Coherent,
    /// Sum of powers.
    Incoherent,
}

/// Cells of an image along each side.
const SIDE: usize = 240;
/// Values per range cell, so that linear interpolation errs by less than 2 % of the peak (π²/8·4²·…, Hann's
/// main lobe).
const FINER: usize = 8;

/// (range beyond the origin in m, value) over the unambiguous range about `middle_m`; Hann, peaks keep their
/// level.
pub(super) fn range_profile(
    frequency_hz: &[f64],
    samples: &[Complex64],
    middle_m: f64,
) -> Vec<(f64, Complex64)> {
    let profile = Profile::of(frequency_hz, samples.iter().copied());
    let count = profile.values.len() as i64;
    let first = (middle_m / profile.cell_m).round() as i64 - count / 2;
    let value = |i: i64| (i as f64 * profile.cell_m, profile.values[i.rem_euclid(count) as usize]);
    (first..first + count).map(value).collect()
}

/// Backprojection of all azimuths onto a square of ±`half_width_m`, in which the body lies; coherent where
/// its `width_m` is sampled once (neighbours differ by λ/(2·width) at most), else power is added.
pub(super) fn image(
    frequency_hz: &[f64],
    azimuth_rad: &[f64],
    table: &ArrayView2<Complex64>,
    [half_width_m, width_m]: [f64; 2],
) -> Image {
    let profiles: Vec<Profile> =
        table.columns().into_iter().map(|c| Profile::of(frequency_hz, c.iter().copied())).collect();
    let wavelength_m = SPEED_OF_LIGHT_MPS / centre(frequency_hz);
    let step = azimuth_rad.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
    let is_dense = step * width_m <= 0.5 * wavelength_m;
    let sum = if is_dense { Sum::Coherent } else { Sum::Incoherent };
    let wavenumber = TAU / wavelength_m;
    let place = |i: usize| half_width_m * (2.0 * (i as f64 + 0.5) / SIDE as f64 - 1.0);
    let cell = |(y, x): (usize, usize)| {
        let (ahead_m, left_m) = (place(y), place(x));
        let value = |(profile, az): (&Profile, &f64)| {
            let range_m = -(az.cos() * ahead_m + az.sin() * left_m);
            profile.at(range_m) * Complex64::cis(2.0 * wavenumber * range_m)
        };
        power(profiles.iter().zip(azimuth_rad).map(value), sum)
    };
    Image { power_m2: Array2::from_shape_fn((SIDE, SIDE), cell), sum }
}

fn power(values: impl ExactSizeIterator<Item = Complex64>, sum: Sum) -> f64 {
    let count = values.len() as f64;
    match sum {
        Sum::Coherent => (values.sum::<Complex64>() / count).norm_sqr(),
        Sum::Incoherent => values.map(|s| s.norm_sqr()).sum::<f64>() / count,
    }
}

/// Samples over equidistant frequencies, transformed; the phase of the centre frequency is taken out.
struct Profile {
    cell_m: f64,
    /// Values at ranges 0, cell, 2·cell, … and, from the end, −cell, …
    values: Vec<Complex64>,
}

impl Profile {
    fn of(frequency_hz: &[f64], samples: impl Iterator<Item = Complex64>) -> Self {
        let count = frequency_hz.len();
        let padded = FINER * count.next_power_of_two();
        let taper = |n: usize| (1.0 - (TAU * (n as f64 + 0.5) / count as f64).cos()) / count as f64;
        let mut values = vec![Complex64::ZERO; padded];
        // The centre frequency goes to index 0, so that values turn slowly with range.
        for (n, s) in samples.enumerate() {
            values[(n + padded - count / 2) % padded] = s * taper(n);
        }
        rustfft::FftPlanner::new().plan_fft_inverse(padded).process(&mut values);
        let step_hz = (frequency_hz[count - 1] - frequency_hz[0]) / (count - 1) as f64;
        Self { cell_m: SPEED_OF_LIGHT_MPS / (2.0 * step_hz.abs() * padded as f64), values }
    }

    /// Linear between cells; ranges repeat.
    fn at(&self, range_m: f64) -> Complex64 {
        let count = self.values.len();
        let place = (range_m / self.cell_m).rem_euclid(count as f64);
        let (below, share) = (place as usize % count, place.fract());
        self.values[below] * (1.0 - share) + self.values[(below + 1) % count] * share
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scatterer(ahead_m: f64, left_m: f64, frequency_hz: &[f64], azimuth_rad: &[f64]) -> Array2<Complex64> {
        Array2::from_shape_fn((frequency_hz.len(), azimuth_rad.len()), |(f, a)| {
            let k = TAU * frequency_hz[f] / SPEED_OF_LIGHT_MPS;
            Complex64::cis(2.0 * k * (azimuth_rad[a].cos() * ahead_m + azimuth_rad[a].sin() * left_m))
        })
    }

    fn frequencies() -> Vec<f64> {
        (0..64).map(|i| 76.5e9 + 1e9 * f64::from(i) / 63.0).collect()
    }

    #[test]
    fn a_scatterer_ahead_of_the_origin_is_nearer_by_its_distance() {
        let table = scatterer(1.2, 0.0, &frequencies(), &[0.0]);
        let profile = range_profile(&frequencies(), &table.column(0).to_vec(), 0.0);
        let peak = profile.iter().max_by(|a, b| a.1.norm().total_cmp(&b.1.norm())).unwrap();
        // A cell of 1 GHz is 0.15 m, shown eight times finer.
        println!("asked −1.2 m, 1 m²; got {:.3} m, {:.3} m²", peak.0, peak.1.norm_sqr());
        assert!((peak.0 + 1.2).abs() < 0.01 && (peak.1.norm() - 1.0).abs() < 0.01);
    }

    #[test]
    fn an_image_puts_a_scatterer_where_it_is() {
        // 0.02 rad, a cross-range cell of 0.1 m, in steps below λ/(2·3 m) = 6.5e-4.
        let azimuths: Vec<f64> = (0..128).map(|i| 0.3 + 1.6e-4 * f64::from(i)).collect();
        let image = image(
            &frequencies(),
            &azimuths,
            &scatterer(0.9, -0.7, &frequencies(), &azimuths).view(),
            [1.5, 3.0],
        );
        let best = image.power_m2.indexed_iter().max_by(|a, b| a.1.total_cmp(b.1)).unwrap().0;
        let place = |i: usize| 1.5 * (2.0 * (i as f64 + 0.5) / SIDE as f64 - 1.0);
        println!("asked (0.9, −0.7), got ({:.2}, {:.2}), {:?}", place(best.0), place(best.1), image.sum);
        assert_eq!(image.sum, Sum::Coherent);
        assert!((place(best.0) - 0.9).abs() < 0.1 && (place(best.1) + 0.7).abs() < 0.1);
    }
}
