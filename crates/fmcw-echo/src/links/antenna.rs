//! Radar equation without σ and without lengths (physics.md §6), and the elements' pattern.

use artifact::Radar;
use artifact::units::power_from_db;
use glam::DVec3;
use std::f64::consts::PI;

/// √(P_t·G_t·G_r)·λ/(4π)^{3/2} in √W·m, gains at boresight, λ at the centre of the sampled sweep.
///
/// Times |a|/(L₁L₂) it is the amplitude of a sample: eq. (7) of the paper with σ taken out, so that σ counts
/// once.
pub fn link_amplitude(radar: &Radar) -> f64 {
    let gain = power_from_db(radar.link.antenna_gain_db);
    radar.link.transmit_power_w.sqrt() * gain * radar.waveform.wavelength_m() / (4.0 * PI).powf(1.5)
}

/// Amplitude gain of an element towards a unit direction, relative to boresight.
pub fn pattern_amplitude(radar: &Radar, axes: &[DVec3; 3], direction: DVec3) -> f64 {
    radar.array.pattern.amplitude(axes.map(|axis| axis.dot(direction)))
}

/// Unit vectors to the right, along the boresight (azimuth from +y towards +x, elevation above the horizon),
/// and up.
pub fn axes(radar: &Radar) -> [DVec3; 3] {
    let (sin_az, cos_az) = radar.boresight_az_rad.sin_cos();
    let (sin_el, cos_el) = radar.boresight_el_rad.sin_cos();
    let right = DVec3::new(cos_az, -sin_az, 0.0);
    let boresight = DVec3::new(sin_az * cos_el, cos_az * cos_el, sin_el);
    [right, boresight, right.cross(boresight)]
}
