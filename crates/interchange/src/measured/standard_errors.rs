//! Standard errors of a detection: the Cramér–Rao bounds that its signal-to-noise ratio leaves, and the cell
//! that it stands for.
//!
//! A tone's frequency has the variance 6/((2π)²ρ) in cells, a direction cosine 1/(2π²σ²ρ) over elements that
//! spread by σ half wavelengths, ρ the power over noise of all channels (the bounds that the tracker of `dsp`
//! takes for its objects). A point of a vehicle stands for all that echoes in its cell, evenly: a twelfth of
//! the cell squared. On the slope of a stronger point it may stand for that one's echo: their distance adds.

use crate::measured::slopes::Slope;
use artifact::Radar;
use artifact::units::power_from_db;
use std::f64::consts::{PI, TAU};

/// Root mean square errors; `None` where nothing is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StandardErrors {
    pub(crate) range_m: f64,
    pub(crate) velocity_mps: f64,
    /// Azimuth in the sensor's axes, at that direction.
    pub(crate) azimuth_rad: Option<f64>,
    /// Elevation in the sensor's axes, at that direction.
    pub(crate) elevation_rad: Option<f64>,
}

/// Errors of a detection of that strength on that slope, in that direction: azimuth and elevation in the
/// sensor's axes.
pub(crate) fn standard_errors(
    radar: &Radar,
    snr_db: f64,
    slope: Slope,
    [azimuth, elevation]: [f64; 2],
) -> StandardErrors {
    let strength = power_from_db(snr_db).max(1.0) * radar.virtual_channels().max(1) as f64;
    let tone = 6.0 / (TAU * TAU * strength) + 1.0 / 12.0;
    // Along the rows the cosine is −cos(elevation)·sin(azimuth), along the columns sin(elevation).
    let steepness = (elevation.cos() * azimuth.cos()).abs();
    StandardErrors {
        range_m: (radar.waveform.range_resolution_m() * tone.sqrt()).hypot(slope.range_m),
        velocity_mps: (radar.velocity_resolution_mps() * tone.sqrt()).hypot(slope.velocity_mps),
        azimuth_rad: cosine_error(radar, 0, strength).map(|error| (error / steepness).min(PI)),
        elevation_rad: cosine_error(radar, 1, strength).map(|error| (error / elevation.cos().abs()).min(PI)),
    }
}

/// Error of a direction cosine along one axis of the aperture, 0 right, 1 up; `None` without extent.
fn cosine_error(radar: &Radar, axis: usize, strength: f64) -> Option<f64> {
    let spread = |elements: &[[f64; 2]]| {
        let count = elements.len().max(1) as f64;
        let mean = elements.iter().map(|e| e[axis]).sum::<f64>() / count;
        elements.iter().map(|e| (e[axis] - mean).powi(2)).sum::<f64>() / count
    };
    let aperture = spread(&radar.array.tx_half_wavelengths) + spread(&radar.array.rx_half_wavelengths);
    (aperture > 0.0).then(|| (0.5 / (PI * PI * aperture * strength)).sqrt())
}
