//! Tapers of the maps, with this crate's error type.

use crate::error::DspError;
use artifact::settings::Window;
use num_complex::Complex64;
use std::f64::consts::PI;

pub use radar::window::noise_bandwidth_bins;
pub(crate) use radar::window::{correlated_bins, fine_transform, noise_correlation, transform};

/// Taper of [`radar::window::taper`].
///
/// # Errors
/// Sidelobe levels of a Chebyshev window outside 10 to 300 dB.
pub fn taper(window: Window, length: usize) -> Result<Vec<f64>, DspError> {
    radar::window::taper(window, length).map_err(|error| DspError::Sidelobes(error.0))
}

/// Amplitude of a cell for a tone at an offset from its centre, relative to the window's middle, where it is
/// real; 1 at the centre.
pub(crate) fn amplitude(taper: &[f64], offset_bins: f64) -> f64 {
    (transform(taper, offset_bins) * Complex64::cis(-PI * offset_bins)).re / taper.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amplitudes_of_hann_s_window_are_its_closed_form() {
        let hann = taper(Window::Hann, 256).unwrap();
        for offset in [-1.5, -0.5, 0.25, 0.5, 1.75, 2.5] {
            let (x, told): (f64, f64) = (PI * offset, amplitude(&hann, offset));
            let asked = x.sin() / (x * (1.0 - offset * offset));
            // Closed for long windows: (π/N)².
            assert!((told - asked).abs() < 1e-3, "{offset}: {told}");
        }
    }
}
