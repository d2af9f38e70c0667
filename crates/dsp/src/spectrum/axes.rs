//! Physical axes of a range-Doppler map, and its shape checked.

use crate::error::DspError;
use artifact::cube::CubeHeader;
use artifact::rdm;
use radar::doppler_ambiguity::wrapped_mps;

/// Range of every column, m: k·ΔR. The beat frequency folds at the last column.
pub fn range_axis_m(header: &CubeHeader) -> Vec<f64> {
    let step_m = header.radar.waveform.range_resolution_m();
    (0..header.radar.waveform.range_cells()).map(|k| k as f64 * step_m).collect()
}

/// Radial velocity of every row, m/s, positive when the range grows; zero at row N/2.
pub fn velocity_axis_mps(header: &CubeHeader) -> Vec<f64> {
    let chirps = header.radar.waveform.chirps as usize;
    (0..chirps).map(|row| velocity_at(header, row as f64)).collect()
}

/// Velocity at a fractional row.
pub(crate) fn velocity_at(header: &CubeHeader, row: f64) -> f64 {
    (row - (header.radar.waveform.chirps / 2) as f64) * header.radar.velocity_resolution_mps()
}

/// Fractional row of a velocity, not wrapped.
pub(crate) fn row_at(header: &CubeHeader, velocity_mps: f64) -> f64 {
    velocity_mps / header.radar.velocity_resolution_mps() + (header.radar.waveform.chirps / 2) as f64
}

/// Range–Doppler coupling of a velocity on this cube's maps, m.
pub(crate) fn coupling_m(header: &CubeHeader, velocity_mps: f64) -> f64 {
    radar::beat::coupling_m(&header.radar.waveform, velocity_mps)
}

/// Range cells per second of round-trip delay times c/2; the sign of the slope is undone when the map is
/// made.
pub(crate) fn column_at(header: &CubeHeader, range_m: f64) -> f64 {
    range_m / header.radar.waveform.range_resolution_m()
}

/// `velocity_mps` brought into one span of the axis, [−λ/4T, λ/4T).
pub(crate) fn wrapped(header: &CubeHeader, velocity_mps: f64) -> f64 {
    wrapped_mps(velocity_mps, 2.0 * header.radar.velocity_max_mps())
}

/// `velocity_mps` moved by whole spans until it is nearest to `near_mps`.
pub(crate) fn unwrapped(header: &CubeHeader, velocity_mps: f64, near_mps: f64) -> f64 {
    near_mps + wrapped(header, velocity_mps - near_mps)
}

/// `[channel, doppler, range]` of a map that this radar can make, or what is missing.
pub(crate) fn checked_shape(header: &CubeHeader) -> Result<[usize; 3], DspError> {
    let radar = &header.radar;
    for (what, count) in [
        ("transmitters", radar.array.tx_m.len()),
        ("receivers", radar.array.rx_m.len()),
        ("chirps", radar.waveform.chirps as usize),
        ("samples", radar.waveform.samples as usize),
    ] {
        if count == 0 {
            return Err(DspError::Missing { what });
        }
    }
    for (quantity, value) in [
        ("slope_hz_per_s", radar.waveform.slope_hz_per_s),
        ("sample_rate_hz", radar.waveform.sample_rate_hz),
        ("chirp_interval_s", radar.waveform.chirp_interval_s),
        ("wavelength_m", radar.waveform.wavelength_m()),
        ("range_resolution_m", radar.waveform.range_resolution_m()),
        ("1 + boresight_az_rad²", 1.0 + radar.boresight_az_rad.powi(2)),
        ("1 + boresight_el_rad²", 1.0 + radar.boresight_el_rad.powi(2)),
        ("1 + |position_m|²", 1.0 + radar.position_m.iter().map(|x| x * x).sum::<f64>()),
        ("1 + Σ|tx_m|²", 1.0 + radar.array.tx_m.iter().flatten().map(|x| x * x).sum::<f64>()),
        ("1 + Σ|rx_m|²", 1.0 + radar.array.rx_m.iter().flatten().map(|x| x * x).sum::<f64>()),
    ] {
        if !value.is_finite() || value == 0.0 {
            return Err(DspError::Radar { quantity, value });
        }
    }
    let (calibration, expected) = (&header.dsp.calibration, header.radar.virtual_channels());
    let found = calibration.iter().filter(|factor| factor.is_finite()).count();
    if !calibration.is_empty() && (found, calibration.len()) != (expected, expected) {
        return Err(DspError::Calibration { expected, found });
    }
    let shape = rdm::shape(header);
    shape.iter().try_fold(1_usize, |product, n| product.checked_mul(*n)).ok_or(DspError::TooLarge)?;
    Ok(shape)
}
