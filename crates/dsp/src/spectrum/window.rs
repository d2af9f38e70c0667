//! Tapers of the maps, with this crate's error type.

use crate::error::DspError;
use artifact::settings::Window;

pub use radar::window::noise_bandwidth_bins;
pub(crate) use radar::window::{noise_correlation, response, transform};

/// Taper of [`radar::window::taper`].
///
/// # Errors
/// Sidelobe levels of a Chebyshev window outside 10 to 300 dB.
pub fn taper(window: Window, length: usize) -> Result<Vec<f64>, DspError> {
    radar::window::taper(window, length).map_err(|error| DspError::Sidelobes(error.0))
}
