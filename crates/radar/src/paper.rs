//! The radar of the paper's Table 2 and a scene's default processing, a starting point for examples and
//! tests.

use crate::aperture::{Elements, mounted};
use artifact::radar::{
    Array, Hardware, Link, Multiplexing, Pattern, Polarization, Radar, Sampling, Schedule, Waveform,
};
use artifact::settings::{Angle, Detector, DspSettings, Lanes, Refine, StaticEchoes, Window};
use artifact::units::watts_from_dbm;

/// Waveform of Table 2 with `samples` per chirp: 77 GHz, 12.5 MHz/µs, complex samples at 5.12 MHz, 10 µs idle
/// between chirps.
pub fn waveform(samples: u32, chirps: u32) -> Waveform {
    let sample_rate_hz = 5.12e6;
    Waveform {
        start_frequency_hz: 77e9,
        slope_hz_per_s: 12.5e12,
        sample_rate_hz,
        sampling: Sampling::Complex,
        samples,
        chirp_interval_s: f64::from(samples) / sample_rate_hz + 10e-6,
        chirps,
    }
}

/// A radar at `position_m` looking along +y, with both rows of elements (half wavelengths) centred on it:
/// isotropic elements of 10 dBi and 12 dBm, vv, all transmitters at once (`docs/physics.md`, link budget).
pub fn radar(position_m: [f64; 3], waveform: Waveform, [tx, rx]: [Elements; 2]) -> Radar {
    mounted(Radar {
        position_m,
        boresight_az_rad: 0.0,
        boresight_el_rad: 0.0,
        waveform,
        schedule: Schedule::default(),
        array: Array {
            tx_m: vec![],
            rx_m: vec![],
            tx_half_wavelengths: tx,
            rx_half_wavelengths: rx,
            multiplexing: Multiplexing::Simultaneous,
            polarization: Polarization::Vv,
            pattern: Pattern::Isotropic,
        },
        link: Link { transmit_power_w: watts_from_dbm(12.0), antenna_gain_db: 10.0 },
        hardware: Hardware::default(),
    })
}

/// Defaults of a scene's `[dsp]`, without lanes: Hann windows, cell averaging, transforms over the array.
pub fn processing() -> DspSettings {
    DspSettings {
        range_window: Window::Hann,
        doppler_window: Window::Hann,
        detector: Detector::CaCfar,
        false_alarm_rate: 1e-5,
        guard_cells: [2, 2],
        training_cells: [4, 8],
        angle: Angle::Fft,
        refine: Refine::Off,
        calibration: vec![],
        static_echoes: StaticEchoes::Keep,
        nearest_m: 0.0,
        assumed_height_m: 0.75,
        cluster_range_m: 2.5,
        cluster_velocity_mps: 1.0,
        cluster_cross_m: 2.5,
        road: Lanes::default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::aperture::{Preset, axes, boresight_yaw_rad, horizontal};
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn the_rows_stand_in_steps_of_half_a_wavelength_around_the_radar() {
        let radar = radar([0.0, 0.0, 6.0], waveform(256, 128), Preset::OneByFour.elements());
        let half_m = 0.5 * radar.waveform.wavelength_m();
        assert_eq!(radar.array.tx_m, [[0.0, 0.0, 6.0]]);
        for (element, steps) in radar.array.rx_m.iter().zip([-1.5, -0.5, 0.5, 1.5]) {
            assert!((element[0] - steps * half_m).abs() < 1e-15 && element[1..] == [0.0, 6.0]);
        }
        assert!((radar.waveform.chirp_interval_s - 60e-6).abs() < 1e-18);
    }

    #[test]
    fn a_boresight_has_the_same_horizontal_direction_by_azimuth_and_by_yaw() {
        let at = |azimuth_rad: f64| {
            let radar = radar([0.0; 3], waveform(64, 16), Preset::OneByOne.elements());
            Radar { boresight_az_rad: azimuth_rad, ..radar }
        };
        for azimuth_rad in [0.0, 0.7, FRAC_PI_2, -2.0] {
            let (y, x) = boresight_yaw_rad(&at(azimuth_rad)).sin_cos();
            let [_, ahead, _] = axes(&at(azimuth_rad));
            let horizontal = horizontal(azimuth_rad);
            assert_eq!([ahead.x, ahead.y], horizontal);
            assert!((horizontal[0] - x).hypot(horizontal[1] - y) < 1e-15, "{azimuth_rad}");
        }
    }
}
