//! Energy, level and signal-to-noise of the map.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::settings::{Noise, Window};
use dsp::RangeDoppler;
use dsp::window::{noise_bandwidth_bins, taper};
use dsp::{Receiver, noise_power, power_map};
use num_complex::{Complex32, Complex64};

#[test]
fn s4_the_unwindowed_map_keeps_the_energy_of_the_samples() {
    for (samples, chirps) in [(256, 128), (101, 37), (1, 5), (7, 1)] {
        let mut header = header(samples, chirps, elements_1x1());
        header.noise = NOISE_12_DB;
        header.dsp.range_window = Window::Rect;
        header.dsp.doppler_window = Window::Rect;
        let frame = cube(&header, &[target([2.0, 20.0, 1.0], [0.0, -3.0, 0.0], 1.0)], 4);
        let map = RangeDoppler::<f64>::new(&header).unwrap().channel(&frame.samples, 0.0);
        let before: f64 =
            frame.samples.iter().map(|x| f64::from(x.re).powi(2) + f64::from(x.im).powi(2)).sum();
        let after: f64 = map.iter().map(|v| v.norm_sqr()).sum();
        let error = (after / (before * map.len() as f64) - 1.0).abs();
        println!("S4, {samples} × {chirps}: asked 1e-12, got {error:.1e}");
        assert!(error < 1e-12);
    }
}

#[test]
fn a_map_in_single_precision_errs_by_what_rounding_its_cube_costs() {
    for (samples, chirps) in [(256, 128), (512, 256), (101, 37), (1024, 8)] {
        let mut header = header(samples, chirps, elements_1x1());
        header.noise = NOISE_12_DB;
        header.dsp.range_window = Window::Chebyshev(80.0);
        let frame = cube(&header, &[target([2.0, 20.0, 1.0], [0.0, -3.0, 0.0], 1.0)], 4);
        let narrow = RangeDoppler::<f32>::new(&header).unwrap().channel(&frame.samples, 0.1);
        let wide = RangeDoppler::<f64>::new(&header).unwrap().channel(&frame.samples, 0.1);
        let energy: f64 = wide.iter().map(|v| v.norm_sqr()).sum();
        let difference =
            |(n, w): (&Complex32, &Complex64)| (Complex64::new(n.re.into(), n.im.into()) - w).norm_sqr();
        let error = (narrow.iter().zip(&wide).map(difference).sum::<f64>() / energy).sqrt();
        // ε/2 for each of four roundings of input and windows, and of every other stage of the transforms.
        let stages = f64::from(samples * chirps).log2();
        let asked = 0.5 * f64::from(f32::EPSILON) * (4.0 + stages).sqrt() * 2.0;
        println!("{samples} × {chirps}: asked {asked:.1e} of the map's energy, got {error:.1e}");
        assert!(error < asked);
    }
}

#[test]
fn a_tone_on_a_bins_centre_gives_amplitude_times_cells_with_every_window() {
    for window in [Window::Rect, Window::Hann, Window::Hamming, Window::Blackman, Window::Chebyshev(80.0)] {
        let mut header = header(64, 32, elements_1x1());
        header.dsp.range_window = window;
        header.dsp.doppler_window = window;
        let tone = |chirp: usize, n: usize| {
            let cycles = 9.0 * n as f64 / 64.0 - 5.0 * chirp as f64 / 32.0;
            Complex64::from_polar(0.25, std::f64::consts::TAU * cycles)
        };
        let samples: Vec<_> = (0..32 * 64)
            .map(|at| tone(at / 64, at % 64))
            .map(|v| Complex32::new(v.re as f32, v.im as f32))
            .collect();
        let map = RangeDoppler::<f64>::new(&header).unwrap().channel(&samples, 0.0);
        // Single-precision samples: 6e-8 of the amplitude each.
        assert!((map[(16 - 5) * 64 + 9].norm() / (0.25 * 32.0 * 64.0) - 1.0).abs() < 1e-6, "{window:?}");
    }
}

/// 10 dBsm where the beat frequency and Doppler fall on a bin's centre near `range_m`.
fn at_bin_centre(header: &artifact::cube::CubeHeader, range_m: f64) -> Target {
    let step = header.radar.waveform.range_resolution_m();
    // The residual video phase −½μτ² does not move a static beat; range cell k is exactly k·ΔR.
    target([0.0, (range_m / step).round() * step, 6.0], [0.0, 0.0, 0.0], 10.0)
}

#[test]
fn s6_ten_dbsm_at_25_40_60_m_has_the_signal_to_noise_ratio_of_the_radar_equation() {
    // physics.md §9: P_t + G_t + G_r − F = −12 dB, no window: 42.9 / 34.75 / 27.7 dB; F = 14 dB makes the
    // sum.
    for (range_m, asked_db) in [(25.0, 42.9), (40.0, 34.75), (60.0, 27.7)] {
        for window in [Window::Rect, Window::Hann] {
            let mut header = header(256, 128, elements_1x1());
            header.noise = Noise::Figure { noise_figure_db: 14.0, temperature_k: 290.0 };
            header.dsp.range_window = window;
            header.dsp.doppler_window = window;
            let asked_db = asked_db - 10.0 * (enbw(window, 256) * enbw(window, 128)).log10();
            let ratio: f64 = (0..16)
                .map(|seed| signal_to_noise(&header, at_bin_centre(&header, range_m), seed))
                .sum::<f64>()
                / 16.0;
            // 16 peaks of 27 dB: 20·log₁₀(1 + 1/√(2·16·500)) = 0.07 dB standard deviation at worst; rounding
            // of the printed figures 0.05.
            assert!(
                (10.0 * ratio.log10() - asked_db).abs() < 0.2,
                "{window:?} at {range_m} m: {} against {asked_db}",
                10.0 * ratio.log10()
            );
        }
    }
}

fn enbw(window: Window, length: usize) -> f64 {
    noise_bandwidth_bins(&taper(window, length).unwrap())
}

/// Peak over the mean of a noise-only map, less the noise under the peak.
fn signal_to_noise(header: &artifact::cube::CubeHeader, target: Target, seed: u64) -> f64 {
    let with = power_map(
        header,
        &Receiver::new(header).unwrap().range_doppler(&cube(header, &[target], seed)).unwrap(),
    )
    .unwrap();
    let without = power_map(
        header,
        &Receiver::new(header).unwrap().range_doppler(&cube(header, &[], seed + 1000)).unwrap(),
    )
    .unwrap();
    with.iter().copied().fold(0.0, f64::max) / without.mean().unwrap() - 1.0
}

#[test]
fn s6_points_report_this_ratio_over_the_maps_own_noise() {
    let mut header = header(256, 128, elements_3x4());
    header.noise = Noise::Figure { noise_figure_db: 14.0, temperature_k: 290.0 };
    let target = at_bin_centre(&header, 40.0);
    let points = Receiver::new(&header).unwrap().process(&cube(&header, &[target], 3)).unwrap().1;
    // 34.75 dB less 3.52 dB for Hann on both axes; 12 channels of 31 dB: 0.06 dB standard deviation, the
    // median 0.05 dB.
    assert!((points.objects[0].snr_db - (34.75 - 3.52)).abs() < 0.3, "{}", points.objects[0].snr_db);
}

#[test]
fn the_noise_level_comes_from_the_map_whatever_stands_in_it() {
    let mut header = header(256, 128, elements_3x4());
    header.noise = NOISE_12_DB;
    let asked = noise_variance(&header) * 256.0 * 128.0 * enbw(Window::Hann, 256) * enbw(Window::Hann, 128);
    for targets in [vec![], vec![target([5.0, 30.0, 1.0], [0.0, -5.0, 0.0], 1000.0)]] {
        let map = Receiver::new(&header).unwrap().range_doppler(&cube(&header, &targets, 7)).unwrap();
        let got = noise_power(&header, &map).unwrap();
        // Median of 32 768 sums of 12 correlated over ≈ 4 cells: 1.25·√(4/12/32768) = 0.4 % standard
        // deviation.
        assert!((got / asked - 1.0).abs() < 0.02, "{}", got / asked);
    }
}

#[test]
fn the_cubes_of_these_tests_are_those_of_the_formula() {
    let header = header(256, 16, elements_3x4());
    let moving = target([5.75, 25.0, 0.75], [0.3, -12.0, 0.0], 10.0);
    let frame = cube(&header, &[moving], 1);
    for (channel, chirp, n) in [(0, 0, 0), (5, 7, 31), (11, 15, 255), (3, 8, 128)] {
        let (amplitude, cycles) = sample_cycles(&header, &moving, [channel / 4, channel % 4], [chirp, n]);
        let asked = Complex64::from_polar(amplitude, std::f64::consts::TAU * cycles);
        let got = frame.samples[(channel * 16 + chirp) * 256 + n];
        let error = (num_complex::Complex64::new(got.re.into(), got.im.into()) - asked).norm() / amplitude;
        // Single precision 6e-8; the amplitude's change over a chirp (0.6 mm of 25 m) 5e-5.
        assert!(error < 6e-5, "{error}");
    }
}
