//! Radar cross section of a detection from the radar equation, where the noise is known.

use crate::aperture::{axes, axes_looking};
use crate::link::link_amplitude;
use crate::window::{noise_bandwidth_bins, taper};
use artifact::cube::CubeHeader;
use artifact::points::Point;
use artifact::radar::{Multiplexing, Sampling};
use artifact::settings::Noise;
use artifact::units::{BOLTZMANN_J_PER_K, db_from_power, power_from_db};

/// Cross section in dBsm: σ = (ρ − 1)·P·B·R⁴/(N_sN_c·(l·g²)²), with ρ the power over noise in a cell of one
/// channel, P = k·T·F·f_s, B the windows' noise bandwidths in cells, l the link amplitude, g the element
/// pattern. `None` if the noise is not thermal, if samples are real or if transmitters use codes.
///
/// An echo between two cells appears up to 1.4 dB weaker per axis with windows like Hann's.
pub fn cross_section_dbsm(header: &CubeHeader, point: &Point) -> Option<f64> {
    let section = (power_from_db(point.snr_db) - 1.0) * section_of_noise_m2(header, point)?;
    (section > 0.0 && section.is_finite()).then(|| db_from_power(section))
}

/// Power over noise, dB, of an echo with this cross section in dBsm at the point's position: the inverse of
/// [`cross_section_dbsm`].
pub fn snr_db_of(header: &CubeHeader, point: &Point, dbsm: f64) -> Option<f64> {
    let ratio = power_from_db(dbsm) / section_of_noise_m2(header, point)? + 1.0;
    (ratio.is_finite() && ratio > 0.0).then(|| db_from_power(ratio))
}

/// Cross section whose echo from the point's position equals the noise, m².
fn section_of_noise_m2(header: &CubeHeader, point: &Point) -> Option<f64> {
    let (radar, waveform) = (&header.radar, &header.radar.waveform);
    let Noise::Figure { noise_figure_db, temperature_k } = header.noise else { return None };
    let is_plain = waveform.sampling == Sampling::Complex && radar.array.multiplexing != Multiplexing::Bpm;
    if !is_plain {
        return None;
    }
    let noise_w =
        BOLTZMANN_J_PER_K * temperature_k * power_from_db(noise_figure_db) * waveform.sample_rate_hz;
    let (samples, chirps) = (waveform.samples as usize, waveform.chirps as usize);
    let bandwidth = noise_bandwidth_bins(&taper(header.dsp.range_window, samples).ok()?)
        * noise_bandwidth_bins(&taper(header.dsp.doppler_window, chirps).ok()?);
    let [_, direction, _] = axes_looking(point.azimuth_rad, point.elevation_rad);
    let cosines = axes(radar).map(|axis| axis.dot(direction));
    let gain = radar.array.pattern.amplitude(cosines).powi(2) * link_amplitude(radar);
    Some(noise_w * bandwidth * point.range_m.powi(4) / ((samples * chirps) as f64 * gain * gain))
}
