//! Link budget: the radar equation without σ and ranges (physics.md §6).

use artifact::Radar;
use artifact::units::power_from_db;
use std::f64::consts::PI;

/// √(P_t·G_t·G_r)·λ/(4π)^{3/2} in √W·m, with gains at boresight and λ at the centre of the sampled sweep.
///
/// Multiplied by |a|/(L₁L₂) it is the amplitude of a sample: eq. (7) of the paper with σ removed, so that σ
/// is counted once.
pub fn link_amplitude(radar: &Radar) -> f64 {
    let gain = power_from_db(radar.link.antenna_gain_db);
    radar.link.transmit_power_w.sqrt() * gain * radar.waveform.wavelength_m() / (4.0 * PI).powf(1.5)
}
