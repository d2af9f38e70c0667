//! Standard errors of a detection: the Cramér–Rao bounds for its signal-to-noise ratio, and the size of its
//! cell.
//!
//! The frequency of a tone has the variance 6/((2π)²ρ) in cells, a direction cosine 1/(2π²σ²ρ) over elements
//! with a spread of σ half wavelengths, where ρ is the ratio of power to noise of all channels (the bounds
//! that the tracker of `dsp` uses for its objects). A point of a vehicle represents all echoes in its cell,
//! uniformly: a twelfth of the cell squared. On the slope of a stronger point it may belong to that one's
//! echo: their distance adds.

use crate::measured::main_lobe::MainLobeOffset;
use artifact::Radar;
use artifact::units::power_from_db;
use std::f64::consts::{PI, TAU};

/// Root mean square errors; `None` if not measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StandardErrors {
    pub(crate) range_m: f64,
    pub(crate) velocity_mps: f64,
    /// Azimuth in the sensor's axes, in the given direction.
    pub(crate) azimuth_rad: Option<f64>,
    /// Elevation in the sensor's axes, in the given direction.
    pub(crate) elevation_rad: Option<f64>,
}

/// Errors of a detection with that strength and slope, in that direction: azimuth and elevation in the
/// sensor's axes.
pub(crate) fn standard_errors(
    radar: &Radar,
    snr_db: f64,
    offset: MainLobeOffset,
    [azimuth, elevation]: [f64; 2],
) -> StandardErrors {
    let strength = power_from_db(snr_db).max(1.0) * radar.virtual_channels().max(1) as f64;
    let tone = 6.0 / (TAU * TAU * strength) + 1.0 / 12.0;
    // The direction cosine along the rows is −cos(elevation)·sin(azimuth), along the columns sin(elevation).
    let steepness = (elevation.cos() * azimuth.cos()).abs();
    StandardErrors {
        range_m: (radar.waveform.range_resolution_m() * tone.sqrt()).hypot(offset.range_m),
        velocity_mps: (radar.velocity_resolution_mps() * tone.sqrt()).hypot(offset.velocity_mps),
        azimuth_rad: cosine_error(radar, 0, strength).map(|error| (error / steepness).min(PI)),
        elevation_rad: cosine_error(radar, 1, strength).map(|error| (error / elevation.cos().abs()).min(PI)),
    }
}

/// Error of a direction cosine along one axis of the aperture, 0 right, 1 up; `None` if the aperture has no
/// extent there.
fn cosine_error(radar: &Radar, axis: usize, strength: f64) -> Option<f64> {
    let spread = |elements: &[[f64; 2]]| {
        let count = elements.len().max(1) as f64;
        let mean = elements.iter().map(|e| e[axis]).sum::<f64>() / count;
        elements.iter().map(|e| (e[axis] - mean).powi(2)).sum::<f64>() / count
    };
    let aperture = spread(&radar.array.tx_half_wavelengths) + spread(&radar.array.rx_half_wavelengths);
    (aperture > 0.0).then(|| (0.5 / (PI * PI * aperture * strength)).sqrt())
}
