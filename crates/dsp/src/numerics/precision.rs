//! The two precisions that maps are made in.

use num_complex::{Complex, Complex32};
use rustfft::FftNum;

/// Single or double precision.
pub trait Precision: FftNum {
    /// The nearest value.
    fn of(value: f64) -> Self;
    /// A sample in this precision.
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
