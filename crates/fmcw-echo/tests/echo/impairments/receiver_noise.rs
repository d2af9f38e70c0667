//! Noise power in the samples and in the map.

use crate::setting::*;
use artifact::cube::CubeHeader;
use artifact::radar::Multiplexing;
use artifact::settings::{Noise, Window};
use fmcw_echo::EchoError;
use num_complex::{Complex32, Complex64};
use radar::window::taper;

fn cube(header: &CubeHeader, paths: Vec<artifact::paths::Path>) -> Vec<Complex32> {
    synthesized(header, 9, &frame(paths)).unwrap().samples
}

/// Mean power of a map's cells: by Parseval's theorem the power of the windowed samples.
fn mean_cell_power(header: &CubeHeader, samples: &[Complex64]) -> f64 {
    let [_, chirps, length] = header.shape();
    let range = taper(header.dsp.range_window, length).unwrap();
    let doppler = taper(header.dsp.doppler_window, chirps).unwrap();
    samples.iter().enumerate().map(|(i, x)| (x * range[i % length] * doppler[i / length]).norm_sqr()).sum()
}

/// Power of the strongest cell, by the transform's definition over the columns that may hold it.
fn peak_cell_power(header: &CubeHeader, samples: &[Complex64], ranges: std::ops::Range<usize>) -> f64 {
    let [_, chirps, length] = header.shape();
    let range = taper(header.dsp.range_window, length).unwrap();
    let doppler = taper(header.dsp.doppler_window, chirps).unwrap();
    let turn = |cells: usize, n: usize, k: usize| {
        Complex64::cis(-std::f64::consts::TAU * (n * k % cells) as f64 / cells as f64)
    };
    let mut peak = 0.0_f64;
    for k in ranges {
        let column: Vec<Complex64> = samples
            .chunks(length)
            .map(|chirp| (0..length).map(|n| chirp[n] * range[n] * turn(length, n, k)).sum::<Complex64>())
            .collect();
        for l in 0..chirps {
            let cell: Complex64 = (0..chirps).map(|m| column[m] * doppler[m] * turn(chirps, m, l)).sum();
            peak = peak.max(cell.norm_sqr());
        }
    }
    peak
}

#[test]
fn s6_an_empty_scene_holds_thermal_noise_of_minus_136_9_dbw_plus_the_noise_figure_in_every_channel() {
    let radar = radar(experiment(1), &presets()[1], Multiplexing::Simultaneous);
    let header = header(radar, Noise::Figure { noise_figure_db: 12.0, temperature_k: 290.0 });
    let samples = widened(&cube(&header, vec![]));
    for channel in samples.chunks(128 * 256) {
        let power_dbw =
            10.0 * (channel.iter().map(|x| x.norm_sqr()).sum::<f64>() / channel.len() as f64).log10();
        // k·290 K·5.12 MHz = −136.88 dBW; the mean of 32 768 exponential powers is known to 1/√32768: 0.024
        // dB, five of them.
        assert!((power_dbw + 136.88 - 12.0).abs() < 0.12, "{power_dbw}");
    }
}

#[test]
fn snr_db_is_the_peak_cell_of_one_channel_over_the_mean_noise_cell_with_the_windows_set() {
    let mut header = header(single_channel(experiment(1)), Noise::Absent);
    let paths = vec![point([2.0, 40.0, 1.0], [0.0, -7.0, 0.0], 3.0), point([2.0, 30.0, 1.0], [0.0; 3], 0.2)];
    for windows in [
        [Window::Hann, Window::Hann],
        [Window::Rect, Window::Chebyshev(80.0)],
        [Window::Blackman, Window::Hamming],
    ] {
        [header.dsp.range_window, header.dsp.doppler_window] = windows;
        header.noise = Noise::Absent;
        let clean = widened(&cube(&header, paths.clone()));
        header.noise = Noise::SnrDb(23.0);
        let noise: Vec<Complex64> = widened(&cube(&header, paths.clone()))
            .iter()
            .zip(&clean)
            .map(|(noisy, clean)| noisy - clean)
            .collect();
        // 40.4 m away, the beat lies in cell 168; Hann's main lobe is four cells wide.
        let peak = peak_cell_power(&header, &clean, 160..176);
        let snr_db = 10.0 * (peak / mean_cell_power(&header, &noise)).log10();
        // 32 768 noise samples, weighted by windows of ENBW ≤ 1.75²: 0.042 dB; five of them.
        assert!((snr_db - 23.0).abs() < 0.21, "{windows:?}: {snr_db}");
    }
}

/// Hann over one chirp has no weight at all: the map's window is flat there, as the detector's is.
#[test]
fn snr_db_refers_to_the_map_of_a_single_chirp_too() {
    let waveform = artifact::Waveform { chirps: 1, ..experiment(1) };
    let mut header = header(single_channel(waveform), Noise::SnrDb(23.0));
    let paths = vec![point([2.0, 40.0, 1.0], [0.0; 3], 3.0)];
    let both = widened(&cube(&header, paths.clone()));
    header.noise = Noise::Absent;
    let clean = widened(&cube(&header, paths));
    let noise: Vec<Complex64> = both.iter().zip(&clean).map(|(both, clean)| both - clean).collect();
    let got = peak_cell_power(&header, &clean, 0..256) / mean_cell_power(&header, &noise);
    // 256 exponential powers are known to 1/16: 0.27 dB, four of them.
    assert!((10.0 * got.log10() - 23.0).abs() < 1.1, "{got}");
}

#[test]
fn snr_db_without_any_echo_is_refused() {
    let header = header(single_channel(experiment(1)), Noise::SnrDb(20.0));
    let refused = synthesized(&header, 1, &frame(vec![]));
    assert_eq!(refused.unwrap_err(), EchoError::NoPeak { frame: 0 });
}

#[test]
fn noise_differs_between_frames_channels_and_seeds_and_not_with_the_echo() {
    let radar =
        radar(artifact::Waveform { chirps: 2, ..experiment(1) }, &presets()[1], Multiplexing::Simultaneous);
    let header = header(radar, Noise::Figure { noise_figure_db: 12.0, temperature_k: 290.0 });
    let of = |seed: u64, index: u32| {
        let frame = artifact::paths::PathsFrame { index, ..frame(vec![]) };
        synthesized(&header, seed, &frame).unwrap().samples
    };
    let base = of(1, 0);
    assert!(base == of(1, 0) && base != of(2, 0) && base != of(1, 1));
    assert_ne!(base[..512], base[512..1024]);
    let paths = vec![point([2.0, 40.0, 1.0], [0.0; 3], 1e-9)];
    let noisy = synthesized(&header, 1, &frame(paths.clone())).unwrap().samples;
    let clean =
        synthesized(&CubeHeader { noise: Noise::Absent, ..header.clone() }, 1, &frame(paths)).unwrap();
    let difference: Vec<Complex64> =
        widened(&noisy).iter().zip(widened(&clean.samples)).map(|(a, b)| a - b).collect();
    // The sum is rounded to f32 once more: 2⁻²⁴ of it.
    assert!(error_db(&difference, &widened(&base)) < -138.0);
}

/// A tone of a whole number of turns over the frame fills its row with the window's sum, whenever the chirps
/// start: staggered, it is as strong as it is at equal steps.
#[test]
fn snr_db_of_staggered_chirps_is_that_of_the_map_by_their_own_times() {
    let of = |stagger_s: Vec<f64>, row: f64| {
        let waveform = artifact::Waveform { chirps: 64, ..experiment(1) };
        let mut header = header(single_channel(waveform), Noise::Absent);
        header.radar.schedule.stagger_s = stagger_s;
        let radar = &header.radar;
        let frame_s = radar.repetition_interval_s() * 64.0;
        let tone = |i: usize| {
            let start_s = radar.chirp_start_s(0, i / 256) - radar.chirp_start_s(0, 0);
            let turns = row * start_s / frame_s + 40.0 * (i % 256) as f64 / 256.0;
            let value = Complex64::cis(2.0 * std::f64::consts::PI * turns);
            Complex32::new(value.re as f32, value.im as f32)
        };
        let samples: Vec<Complex32> = (0..64 * 256).map(tone).collect();
        10.0 * fmcw_echo::snr_reference::peak_cell_over_noise(&header, &samples).unwrap().log10()
    };
    for row in [0.0, 7.0, -20.0, 31.0] {
        let (even, staggered) = (of(vec![], row), of(vec![0.0, 9e-6, 4e-6, 0.0, 7e-6], row));
        println!("row {row}: {even:.4} dB at equal steps, {staggered:.4} dB staggered");
        // Samples are single precision.
        assert!((staggered - even).abs() < 1e-5, "row {row}: {staggered} of {even} dB");
    }
}

/// Transmitters in phase straight ahead: the sum of the slots' powers is M·N_tx times one transmitter's, the
/// noise of a slot one.
#[test]
fn snr_db_under_codes_is_that_of_the_transmitters_taken_apart() {
    let at = |multiplexing| {
        let radar = radar(artifact::Waveform { chirps: 16, ..experiment(1) }, &presets()[2], multiplexing);
        let header = header(radar, Noise::Absent);
        let still = point([2.0, 40.0, 1.0], [0.0; 3], 3.0);
        fmcw_echo::snr_reference::peak_cell_over_noise(&header, &cube(&header, vec![still])).unwrap()
    };
    let gain = at(Multiplexing::Bpm) / at(Multiplexing::Simultaneous);
    println!("codes over ideal transmitters of as many repetitions: {gain:.5}, asked 4");
    // Σ_s |Σ_i H_is·x_i|²/N_tx = M·mean |x_i|²; distances of the elements differ by 1e-4.
    assert!((gain - 4.0).abs() < 4.0 * 1e-3, "{gain}");
}
