//! Maps of real samples.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::alarm_rates;
use crate::common::*;
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::radar::Sampling;
use artifact::settings::{Refine, Window};
use dsp::cfar::{DETECTED, UNTESTED};
use dsp::{DspError, Receiver, power_map, range_axis_m};
use rayon::prelude::*;

fn real(samples: u32, chirps: u32) -> CubeHeader {
    let mut header = header(samples, chirps, elements_1x1());
    header.radar.waveform.sampling = Sampling::Real;
    header
}

/// The real parts of what complex sampling has.
fn real_cube(header: &CubeHeader, targets: &[Target], seed: u64) -> CubeFrame {
    let mut cube = cube(header, targets, seed);
    cube.samples.iter_mut().for_each(|sample| sample.im = 0.0);
    cube
}

#[test]
fn rising_and_falling_chirps_show_range_and_velocity_in_the_half_that_is_kept() {
    for slope in [12.5e12, -12.5e12] {
        let mut header = real(256, 64);
        header.radar.waveform.slope_hz_per_s = slope;
        header.dsp.range_window = Window::Chebyshev(100.0);
        let target = target([0.0, 20.0, 6.0], [0.0, -5.0, 0.0], 1.0);
        let receiver = Receiver::new(&header).unwrap();
        let map = receiver.range_doppler(&real_cube(&header, &[target], 1)).unwrap();
        assert_eq!((range_axis_m(&header).len(), map.values.len()), (128, 128 * 64));
        let point = receiver.detect(&map).unwrap().points[0];
        println!("slope {slope:e}: {:.3} m, {:.3} m/s", point.range_m, point.radial_velocity_mps);
        // 5 m/s move 0.01 m to the frame's middle; cells are 0.24 m and 0.51 m/s, told to a hundredth.
        assert!((point.range_m - 19.99).abs() < 0.03 && (point.radial_velocity_mps + 5.0).abs() < 0.02);
        // The same in the half that complex samples show, of half the amplitude: the image is the window's
        // −100 dB away.
        let mut whole = header.clone();
        whole.radar.waveform.sampling = Sampling::Complex;
        let complex = Receiver::new(&whole).unwrap().range_doppler(&cube(&whole, &[target], 1)).unwrap();
        let [half, all] = [power_map(&header, &map).unwrap(), power_map(&whole, &complex).unwrap()];
        let peak = half.iter().copied().fold(0.0, f64::max);
        let worst = half
            .indexed_iter()
            .map(|(at, power)| (power.sqrt() - 0.5 * all[at].sqrt()).abs())
            .fold(0.0, f64::max);
        assert!(worst < 2e-5 * peak.sqrt(), "{:e}", worst / peak.sqrt());
    }
}

#[test]
fn noise_of_real_samples_alarms_at_the_rate_asked_for_in_the_interior_and_at_both_edges() {
    for window in [Window::Rect, Window::Hann] {
        for rate in [1e-2, 1e-3] {
            let mut header = real(64, 32);
            header.noise = NOISE_12_DB;
            header.dsp.false_alarm_rate = rate;
            (header.dsp.range_window, header.dsp.doppler_window) = (window, window);
            // Range edges: six cells of guard and training at the default's 2 and 8, near and far apart.
            let zone = |cell: usize| match cell % 32 {
                0..=9 => 0,
                22.. => 2,
                _ => 1,
            };
            let maps = if rate == 1e-2 { 600 } else { 6000 };
            let receiver = Receiver::new(&header).unwrap();
            let counts: Vec<[[u64; 3]; 2]> = (0..maps)
                .into_par_iter()
                .map(|seed| {
                    let map = receiver.range_doppler(&real_cube(&header, &[], seed)).unwrap();
                    let mut counts = [[0; 3]; 2];
                    for (cell, state) in map.mask.iter().enumerate() {
                        counts[0][zone(cell)] += u64::from(*state != UNTESTED);
                        counts[1][zone(cell)] += u64::from(*state == DETECTED);
                    }
                    counts
                })
                .collect();
            let sum = |kind: usize, zone: usize| counts.iter().map(|c| c[kind][zone]).sum::<u64>() as f64;
            let ratios = [0, 1, 2].map(|zone| sum(1, zone) / sum(0, zone) / rate);
            println!(
                "{window:?}, asked {rate:e}: near {:.3}, interior {:.3}, far {:.3}",
                ratios[0], ratios[1], ratios[2]
            );
            // Some 1500 alarms a zone: 2.6 %; three of them with a few windows' correlated cells. With
            // windows as for complex samples.
            let (low, high) = if window == Window::Rect { (0.9, 1.1) } else { (0.8, 1.3) };
            assert!(
                ratios.iter().all(|ratio| (low..=high).contains(ratio)),
                "{window:?}, {rate}: {ratios:?}"
            );
        }
    }
}

#[test]
fn all_detectors_keep_the_rate_next_to_range_0_and_to_half_the_sample_rate() {
    // Where images are taken for cells of their own, SO alarms 7.6 times as often as asked at 1e-6 (Rect,
    // next to range 0, on the rows of images).
    for (window, channels, maps) in [(Window::Rect, 1, 150), (Window::Hann, 1, 150), (Window::Hann, 12, 60)] {
        let header = alarm_rates::noise_header(Sampling::Real, window, channels);
        alarm_rates::assert_weighed(&header, &[1e-3], maps);
    }
}

#[test]
fn cells_whose_noise_is_not_circular_are_not_tested_and_imaginary_parts_are_refused() {
    for (window, untested) in [(Window::Rect, vec![0]), (Window::Hann, vec![0, 1, 127])] {
        let mut header = real(256, 32);
        header.dsp.range_window = window;
        let map = Receiver::new(&header).unwrap().range_doppler(&real_cube(&header, &[], 1)).unwrap();
        let found: Vec<usize> = (0..128).filter(|column| map.mask[*column] == UNTESTED).collect();
        assert_eq!(found, untested, "{window:?}");
    }
    let mut header = real(256, 32);
    let target = target([0.0, 20.0, 6.0], [0.0; 3], 1.0);
    let refused = mapped(&header, &cube(&header, &[target], 1)).unwrap_err();
    assert!(matches!(refused, DspError::NotReal { channel: 0, chirp: 0, .. }), "{refused}");
    let cube = real_cube(&header, &[target], 1);
    let map = Receiver::new(&header).unwrap().range_doppler(&cube).unwrap();
    header.dsp.refine = Refine::Isolated;
    assert!(matches!(
        Receiver::new(&header).and_then(|receiver| receiver.detect_refined(&map, &cube)),
        Err(DspError::Refinement)
    ));
}
