//! Tapers of the maps, with this stage's error.

use crate::error::DspError;
use artifact::settings::Window;

pub use radar::window::noise_bandwidth_bins;
pub(crate) use radar::window::{noise_correlation, response, transform};

/// [`radar::window::taper`].
///
/// # Errors
/// Sidelobes of a Chebyshev window outside of 10 to 300 dB.
pub fn taper(window: Window, length: usize) -> Result<Vec<f64>, DspError> {
    radar::window::taper(window, length).map_err(|error| DspError::Sidelobes(error.0))
}
