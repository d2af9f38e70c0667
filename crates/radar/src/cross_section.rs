//! Radar cross section of a detection from the radar equation, where the noise is known.

use crate::aperture::{axes, boresight_axes};
use crate::link::link_amplitude;
use crate::window::{noise_bandwidth_bins, taper};
use artifact::Radar;
use artifact::cube::CubeHeader;
use artifact::points::Point;
use artifact::radar::{Multiplexing, Sampling};
use artifact::settings::Noise;
use artifact::units::{BOLTZMANN_J_PER_K, db_from_power, power_from_db};

/// Cross section in dBsm: σ = ρ·P·B·R⁴/(q·N_sN_c·(l·g²)²), with ρ the signal-to-noise ratio in a cell of one
/// transmit–receive pair, P = k·T·F·f_s, B the windows' noise bandwidths in cells, q the gain of
/// `separation_gain`, l the link amplitude, g the element pattern. `None` if the noise is not thermal.
///
/// An echo between two cells appears up to 1.4 dB weaker per axis with windows like Hann's.
pub fn cross_section_dbsm(header: &CubeHeader, point: &Point) -> Option<f64> {
    let section = power_from_db(point.snr_db) * section_of_noise_m2(header, point)?;
    (section > 0.0 && section.is_finite()).then(|| db_from_power(section))
}

/// Signal-to-noise ratio, dB, of an echo with this cross section in dBsm at the point's position: the inverse
/// of [`cross_section_dbsm`].
pub fn snr_db_of(header: &CubeHeader, point: &Point, dbsm: f64) -> Option<f64> {
    let ratio = power_from_db(dbsm) / section_of_noise_m2(header, point)?;
    (ratio.is_finite() && ratio > 0.0).then(|| db_from_power(ratio))
}

/// Cross section whose echo from the point's position equals the noise, m².
fn section_of_noise_m2(header: &CubeHeader, point: &Point) -> Option<f64> {
    let (radar, waveform) = (&header.radar, &header.radar.waveform);
    let Noise::Figure { noise_figure_db, temperature_k } = header.noise else { return None };
    let noise_w =
        BOLTZMANN_J_PER_K * temperature_k * power_from_db(noise_figure_db) * waveform.sample_rate_hz;
    let (samples, chirps) = (waveform.samples as usize, waveform.chirps as usize);
    let bandwidth = noise_bandwidth_bins(&taper(header.dsp.range_window, samples).ok()?)
        * noise_bandwidth_bins(&taper(header.dsp.doppler_window, chirps).ok()?);
    let [_, direction, _] = boresight_axes(point.azimuth_rad, point.elevation_rad);
    let cosines = axes(radar).map(|axis| axis.dot(direction));
    let gain = radar.array.pattern.amplitude(cosines).powi(2) * link_amplitude(radar);
    let gathered = separation_gain(radar) * (samples * chirps) as f64;
    Some(noise_w * bandwidth * point.range_m.powi(4) / (gathered * gain * gain))
}

/// Signal-to-noise ratio of a pair over that of complex samples of one transmitter alone, with as many
/// chirps.
///
/// Codes average a pair over their M slots, whose noise is independent: M. Real samples have half of the
/// noise, and in the half of the map that is kept half of an echo's amplitude: ½ (`docs/echo.md`).
fn separation_gain(radar: &Radar) -> f64 {
    let of_codes = match radar.array.multiplexing {
        Multiplexing::Bpm => radar.slots() as f64,
        Multiplexing::Simultaneous | Multiplexing::Tdm | Multiplexing::Ddm => 1.0,
    };
    match radar.waveform.sampling {
        Sampling::Complex => of_codes,
        Sampling::Real => 0.5 * of_codes,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::aperture::Preset;
    use crate::paper;
    use artifact::points::Height;
    use artifact::settings::{DspSettings, Window};

    fn point(range_m: f64, snr_db: f64) -> Point {
        Point {
            range_m,
            radial_velocity_mps: 0.0,
            azimuth_rad: 0.0,
            elevation_rad: 0.0,
            height: Height::Assumed,
            position_m: [0.0, range_m, 0.0],
            snr_db,
            two_ways_rad: None,
            stationary: None,
            object: None,
            target: None,
            label: None,
        }
    }

    /// Three transmitters and four receivers whose signals are complex and ideally separated.
    fn header() -> CubeHeader {
        let (range_window, doppler_window) = (Window::Rect, Window::Rect);
        CubeHeader {
            radar: paper::radar([0.0; 3], paper::waveform(256, 128), Preset::ThreeByFour.elements()),
            noise: Noise::Figure { noise_figure_db: 14.0, temperature_k: 290.0 },
            dsp: DspSettings { range_window, doppler_window, ..paper::processing() },
            unit: Default::default(),
        }
    }

    #[test]
    fn echoes_weaker_than_the_noise_too_have_the_cross_section_of_the_link_budget() {
        let header = header();
        // physics.md §9, told to a tenth: 10 dBsm at 40 and at 60 m.
        for (range_m, ten_dbsm_db) in [(40.0, 34.8), (60.0, 27.7)] {
            for snr_db in [30.0, 10.0, 0.0, -7.0] {
                let told = cross_section_dbsm(&header, &point(range_m, snr_db)).unwrap();
                assert!((told - (10.0 + snr_db - ten_dbsm_db)).abs() < 0.06, "{range_m} {snr_db}: {told}");
                let back = snr_db_of(&header, &point(range_m, 0.0), told).unwrap();
                assert!((back - snr_db).abs() < 1e-9, "{back}");
            }
        }
    }

    /// `docs/echo.md` measures noise that is a quarter of that of ideal transmitters in the map of codes of
    /// 3 × 4 elements, and an echo that is 3.0 dB weaker over its noise where samples are real.
    #[test]
    fn codes_gain_their_number_of_slots_and_real_samples_lose_half() {
        let plain_db = snr_db_of(&header(), &point(40.0, 0.0), 10.0).unwrap();
        for (multiplexing, sampling, gain) in [
            (Multiplexing::Tdm, Sampling::Complex, 1.0),
            (Multiplexing::Ddm, Sampling::Complex, 1.0),
            (Multiplexing::Bpm, Sampling::Complex, 4.0),
            (Multiplexing::Tdm, Sampling::Real, 0.5),
            (Multiplexing::Bpm, Sampling::Real, 2.0),
        ] {
            let mut header = header();
            header.radar.array.multiplexing = multiplexing;
            header.radar.waveform.sampling = sampling;
            let snr_db = snr_db_of(&header, &point(40.0, 0.0), 10.0).unwrap();
            assert!((snr_db - plain_db - db_from_power(gain)).abs() < 1e-9, "{multiplexing:?} {sampling:?}");
            let told = cross_section_dbsm(&header, &point(40.0, snr_db)).unwrap();
            assert!((told - 10.0).abs() < 1e-9, "{multiplexing:?} {sampling:?}: {told}");
        }
    }
}
