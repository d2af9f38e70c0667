//! X2 and the radar equation: what one point target looks like in the samples.

use crate::setting::*;
use artifact::radar::{Multiplexing, Pattern, Radar};
use artifact::settings::Noise;
use artifact::units::SPEED_OF_LIGHT_MPS;
use fmcw_echo::noise::thermal_variance_w;
use num_complex::Complex64;
use std::f64::consts::PI;

/// Noise-free samples of one point on one channel, as stored.
fn samples(radar: &Radar, position_m: [f64; 3], velocity_mps: [f64; 3], rcs_m2: f64) -> Vec<Complex64> {
    let paths = vec![point(position_m, velocity_mps, rcs_m2)];
    let cube = synthesized(&header(radar.clone(), Noise::Absent), 1, &frame(paths)).unwrap();
    widened(&cube.samples)
}

/// Mean phase step from chirp to chirp at the sample in the middle of the sweep, −π … π.
fn turn_per_chirp_rad(radar: &Radar, samples: &[Complex64]) -> f64 {
    let length = radar.waveform.samples as usize;
    let middle: Vec<Complex64> = samples.chunks(length).map(|chirp| chirp[length / 2]).collect();
    middle.windows(2).map(|pair| pair[1] * pair[0].conj()).sum::<Complex64>().arg()
}

#[test]
fn x2_a_target_receding_at_10_mps_turns_1_944_rad_a_chirp_at_60_us() {
    let radar = single_channel(experiment(1));
    let samples = samples(&radar, [0.0, 40.0, 6.0], [0.0, 10.0, 0.0], 1.0);
    // 4πvT_c/λ = 1.9443; f_c − μτ instead of f_c lowers it by 4e-5 of itself.
    let turn = turn_per_chirp_rad(&radar, &samples);
    assert!((turn - 1.944).abs() < 5e-4, "{turn}");
}

#[test]
fn x2_a_target_receding_at_10_mps_shows_minus_7_5548_mps_in_experiment_3() {
    let radar = single_channel(experiment(3));
    let samples = samples(&radar, [0.0, 40.0, 6.0], [0.0, 10.0, 0.0], 1.0);
    let waveform = &radar.waveform;
    let shown = turn_per_chirp_rad(&radar, &samples) * waveform.wavelength_m()
        / (4.0 * PI * waveform.chirp_interval_s);
    // At the middle of the sweep the wave that comes back has f_c − μτ: 3.3 MHz of 77.6 GHz, 4.3e-4 m/s of 10
    // m/s.
    assert!((shown + 7.5548).abs() < 6e-4, "{shown}");
}

#[test]
fn x2_range_grows_by_v_f_c_over_slope_61_85_61_98_62_10_mm() {
    for (number, expected_mm) in [(1, 61.85), (2, 61.98), (3, 62.10)] {
        let radar = single_channel(experiment(number));
        let (start_m, speed_mps) = (40.0, 10.0);
        let samples = samples(&radar, [0.0, start_m, 6.0], [0.0, speed_mps, 0.0], 1.0);
        let waveform = &radar.waveform;
        let middle = waveform.samples as usize / 2;
        // The central difference of a parabola is its slope at the middle; two samples turn by less than half
        // a cycle more or less than twice the beat of 40 m.
        let expected_cycles =
            2.0 * 2.0 * start_m / SPEED_OF_LIGHT_MPS * waveform.slope_hz_per_s / waveform.sample_rate_hz;
        let turn_cycles = (samples[middle + 1] * samples[middle - 1].conj()).arg() / (2.0 * PI);
        let cycles = turn_cycles + (expected_cycles - turn_cycles).round();
        let beat_hz = 0.5 * cycles * waveform.sample_rate_hz;
        let apparent_m = beat_hz * SPEED_OF_LIGHT_MPS / (2.0 * waveform.slope_hz_per_s);
        let true_m = start_m + speed_mps * middle as f64 / waveform.sample_rate_hz;
        // Left out of v·f_c/μ: −μττ̇ (2.7 µm), the way during the flight (1.3 µm), f32 (6e-8 rad over two
        // samples: 0.1 µm).
        let coupling_mm = 1e3 * (apparent_m - true_m);
        assert!((coupling_mm - expected_mm).abs() < 0.005 + 0.005, "{coupling_mm} against {expected_mm}");
    }
}

#[test]
fn s6_ten_dbsm_stand_over_thermal_noise_as_the_radar_equation_says() {
    // P_t + G_t + G_r − F = 12 dBm − 30 + 10 + 10 − 14 = −12 dB; level of a map cell without window.
    let radar = single_channel(experiment(1));
    let noise_w = thermal_variance_w(14.0, 290.0, radar.waveform.sample_rate_hz).unwrap();
    for (range_m, snr_db) in [(25.0, 42.9), (40.0, 34.75), (60.0, 27.7)] {
        let samples = samples(&radar, [0.0, range_m, 6.0], [0.0; 3], linear(10.0));
        let power_w = samples.iter().map(|x| x.norm_sqr()).sum::<f64>() / samples.len() as f64;
        let got = 10.0 * (power_w * samples.len() as f64 / noise_w).log10();
        assert!((got - snr_db).abs() < 0.06, "{range_m} m: {got} against {snr_db}"); // given to 0.1 dB
    }
}

#[test]
fn every_sample_has_the_amplitude_of_eq_7() {
    let radar = single_channel(experiment(2));
    let lambda_m = radar.waveform.wavelength_m();
    for (range_m, rcs_m2) in [(12.5_f64, 0.3), (40.0, 10.0), (59.0, 1000.0)] {
        let expected_w = radar.link.transmit_power_w * linear(20.0) * rcs_m2 * lambda_m.powi(2)
            / ((4.0 * PI).powi(3) * range_m.powi(4));
        for x in samples(&radar, [0.0, range_m, 6.0], [0.0; 3], rcs_m2) {
            // f32 rounds each part by at most 2⁻²⁴ of itself.
            assert!((x.norm_sqr() / expected_w - 1.0).abs() < 4.0 * 2.0_f64.powi(-24));
        }
    }
}

#[test]
fn s5_a_target_to_the_right_is_nearer_to_the_elements_on_the_right() {
    let radar = radar(experiment(1), &presets()[2], Multiplexing::Simultaneous);
    let (range_m, sine) = (40.0, 0.2_f64);
    let position_m = [range_m * sine, range_m * (1.0 - sine * sine).sqrt(), 6.0];
    let samples = samples(&radar, position_m, [0.0; 3], 1.0);
    let row = samples.len() / radar.virtual_channels();
    let middle = radar.waveform.samples as usize / 2;
    for channel in 1..radar.virtual_channels() {
        // Half a wavelength further right: e^{−jπu}. Left out: the wavefront's curvature, (5 λ/2)²·k/2R =
        // 0.004 rad between neighbours, and f_c − μτ for f_c.
        let turn = (samples[channel * row + middle] * samples[(channel - 1) * row + middle].conj()).arg();
        assert!((turn + PI * sine).abs() < 0.008, "channel {channel}: {turn}");
    }
}

#[test]
fn a_cosine_pattern_weakens_both_ways_and_is_silent_behind() {
    let mut radar = single_channel(experiment(1));
    let level = |radar: &Radar, position_m: [f64; 3]| samples(radar, position_m, [0.0; 3], 1.0)[0].norm();
    let (aside, behind) = ([30.0 * 0.6, 30.0 * 0.8, 6.0], [0.0, -30.0, 6.0]);
    let isotropic = level(&radar, aside);
    radar.array.pattern = Pattern::Cosine { exponent: 1.5 };
    // cos = 0.8 off boresight, amplitude 0.8^1.5 each way.
    assert!((level(&radar, aside) / isotropic - 0.8_f64.powi(3)).abs() < 1e-6);
    assert_eq!(level(&radar, behind), 0.0);
}
