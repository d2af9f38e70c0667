//! Precision of a grid: single down to −100 dB, double below.

use num_complex::Complex;
use rustfft::FftNum;

/// Precision of a grid's values: f32 or f64.
pub(crate) trait Scalar: FftNum + Default {
    /// Converts a value to the nearest one in this precision.
    fn of(value: f64) -> Self;
    /// Converts the value to its stored form.
    fn stored(value: Complex<Self>) -> Complex<f64>;
}

impl Scalar for f32 {
    fn of(value: f64) -> Self {
        value as Self
    }

    fn stored(value: Complex<Self>) -> Complex<f64> {
        Complex::new(value.re.into(), value.im.into())
    }
}

impl Scalar for f64 {
    fn of(value: f64) -> Self {
        value
    }

    fn stored(value: Complex<Self>) -> Complex<f64> {
        value
    }
}

/// Rounds a value to the grid's precision.
pub(crate) fn rounded<T: Scalar>(value: Complex<f64>) -> Complex<T> {
    Complex::new(T::of(value.re), T::of(value.im))
}
