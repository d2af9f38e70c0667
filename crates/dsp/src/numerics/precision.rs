//! Floating-point precisions in which maps are computed.

use num_complex::{Complex, Complex32};
use rustfft::FftNum;

/// Single or double precision.
pub trait Precision: FftNum {
    /// Converts a value to the nearest one in this precision.
    fn of(value: f64) -> Self;
    /// Converts a sample to this precision.
    fn of_sample(sample: Complex32) -> Complex<Self>;
}

impl Precision for f32 {
    fn of(value: f64) -> Self {
        value as Self
    }

    fn of_sample(sample: Complex32) -> Complex<Self> {
        sample
    }
}

impl Precision for f64 {
    fn of(value: f64) -> Self {
        value
    }

    fn of_sample(sample: Complex32) -> Complex<Self> {
        Complex::new(Self::from(sample.re), Self::from(sample.im))
    }
}
