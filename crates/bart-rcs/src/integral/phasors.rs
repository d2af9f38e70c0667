//! Phasors e^{−jkℓ} of one length at several wavenumbers: one sine and cosine, and short rotations from
//! there.
//!
//! Over a chirp's band the phase of a tile of a few centimetres varies by less than half a radian between
//! wavenumbers; for so little, seven terms of the series are as accurate as the library's sine, and cheaper.

use num_complex::Complex64;

/// Number of wavenumbers processed together without heap memory: the points of a small tile, with some to
/// spare.
pub(crate) const WAVENUMBERS_PER_BATCH: usize = 16;

/// Phasors at up to [`WAVENUMBERS_PER_BATCH`] wavenumbers.
pub(crate) type Phasors = [Complex64; WAVENUMBERS_PER_BATCH];

/// Phasors of one length around a middle wavenumber.
#[derive(Clone, Copy)]
pub(crate) struct PhasorRotation {
    length_m: f64,
    middle_per_m: f64,
    at_middle: Complex64,
}

impl PhasorRotation {
    /// Phasors of a length around the middle wavenumber.
    pub(crate) fn of(length_m: f64, wavenumbers_per_m: &[f64]) -> Self {
        let middle_per_m = wavenumbers_per_m.get(wavenumbers_per_m.len() / 2).copied().unwrap_or(0.0);
        Self { length_m, middle_per_m, at_middle: phasor(-middle_per_m * length_m) }
    }

    /// Phasor e^{−jkℓ}; error: 2 ε in addition to that of k·ℓ.
    pub(crate) fn at(&self, wavenumber_per_m: f64) -> Complex64 {
        let further = (self.middle_per_m - wavenumber_per_m) * self.length_m;
        if further.abs() <= SHORT {
            self.at_middle * short_phasor(further)
        } else {
            Complex64::cis(-wavenumber_per_m * self.length_m)
        }
    }
}

/// Phasors e^{−jkℓ} at the first [`WAVENUMBERS_PER_BATCH`] of the wavenumbers.
pub(crate) fn phasors(length_m: f64, wavenumbers_per_m: &[f64]) -> Phasors {
    let turning = PhasorRotation::of(length_m, wavenumbers_per_m);
    let mut turns = [Complex64::ZERO; WAVENUMBERS_PER_BATCH];
    turns.iter_mut().zip(wavenumbers_per_m).for_each(|(turn, k)| *turn = turning.at(*k));
    turns
}

/// Phasor e^{jx} for any x.
fn phasor(x: f64) -> Complex64 {
    if x.abs() <= SHORT { short_phasor(x) } else { Complex64::cis(x) }
}

/// Maximum angle of [`short_phasor`], rad.
pub(crate) const SHORT: f64 = 0.5;

/// Phasor e^{jx} for |x| ≤ [`SHORT`] by series: the next terms are below x¹⁵/15! = 2e-17 and x¹⁶/16! = 7e-19.
pub(crate) fn short_phasor(x: f64) -> Complex64 {
    let square = x * x;
    let sum =
        |inverses: [f64; 7]| inverses.iter().rev().fold(1.0, |sum, inverse| 1.0 - square * inverse * sum);
    // Ratios of consecutive terms: 1/((2n − 1)·2n) and 1/(2n·(2n + 1)).
    let cos = sum([1.0 / 2.0, 1.0 / 12.0, 1.0 / 30.0, 1.0 / 56.0, 1.0 / 90.0, 1.0 / 132.0, 1.0 / 182.0]);
    Complex64::new(cos, x * sinc_sum(square))
}

/// Quotient sin x/x for |x| ≤ [`SHORT`].
pub(crate) fn short_sinc(x: f64) -> f64 {
    sinc_sum(x * x)
}

fn sinc_sum(square: f64) -> f64 {
    let inverses = [1.0 / 6.0, 1.0 / 20.0, 1.0 / 42.0, 1.0 / 72.0, 1.0 / 110.0, 1.0 / 156.0];
    inverses.iter().rev().fold(1.0, |sum, inverse| 1.0 - square * inverse * sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_those_of_sines_and_cosines_over_twelve_decades_of_length() {
        let wavenumbers_per_m: Vec<f64> = (0..12).map(|i| 1592.9 + 9.5 * f64::from(i)).collect();
        let mut worst = 0.0_f64;
        for step in -100..=20 {
            let length_m = 10_f64.powf(0.1 * f64::from(step));
            for (turn, k) in phasors(length_m, &wavenumbers_per_m).iter().zip(&wavenumbers_per_m) {
                // k·ℓ itself is rounded.
                let rounding = k * length_m * f64::EPSILON;
                worst = worst.max((turn - Complex64::cis(-k * length_m)).norm() - rounding);
            }
        }
        let short = |i: i32| SHORT * f64::from(i) / 50.0;
        let sinc = |x: f64| (short_sinc(x) - if x == 0.0 { 1.0 } else { x.sin() / x }).abs();
        worst = (-50..=50).map(short).fold(worst, |worst, x| worst.max(sinc(x)));
        println!("asked 1e-15, got {worst:.1e}");
        assert!(worst < 1e-15);
    }
}
