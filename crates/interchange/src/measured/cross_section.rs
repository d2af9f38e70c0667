//! Radar cross section of a detection by the radar equation, where the noise is known.

use crate::measured::sensor_axes::SensorAxes;
use artifact::cube::CubeHeader;
use artifact::points::Point;
use artifact::radar::{Multiplexing, Sampling};
use artifact::settings::Noise;
use artifact::units::{BOLTZMANN_J_PER_K, db_from_power, power_from_db};
use radar::link::link_amplitude;
use radar::window::{noise_bandwidth_bins, taper};

/// Cross section in dBsm: σ = (ρ − 1)·P·B·R⁴/(N_sN_c·(l·g²)²), ρ the power over noise in a cell of one
/// channel, P = k·T·F·f_s, B the windows' noise bandwidths in cells, l the link's amplitude, g the element's
/// pattern. `None` where the noise is not thermal, where samples are real or where transmitters have codes.
///
/// An echo between two cells shows up to 1.4 dB less for each axis with windows like Hann's.
pub(crate) fn cross_section_dbsm(header: &CubeHeader, axes: &SensorAxes, point: &Point) -> Option<f64> {
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
    let echo = power_from_db(point.snr_db) - 1.0;
    let direction = radar::aperture::axes_looking(point.azimuth_rad, point.elevation_rad)[1];
    let gain = radar.array.pattern.amplitude(axes.cosines(direction)).powi(2) * link_amplitude(radar);
    let section =
        echo * noise_w * bandwidth * point.range_m.powi(4) / ((samples * chirps) as f64 * gain * gain);
    (section > 0.0 && section.is_finite()).then(|| db_from_power(section))
}
