//! Transmitters told apart by binary codes: noise, velocities, directions, and what is refused.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::cube::CubeHeader;
use artifact::points::Object;
use artifact::radar::Multiplexing;
use artifact::settings::Window;
use dsp::angle::Direction;
use dsp::cfar::DETECTED;
use dsp::least_loss;
use dsp::{DspError, Receiver, noise_power, power_map};
use rayon::prelude::*;

fn coded(samples: u32, blocks: u32, elements: [Vec<[f64; 2]>; 2]) -> CubeHeader {
    let mut header = header(samples, blocks, elements);
    header.radar.array.multiplexing = Multiplexing::Bpm;
    header
}

/// 128 samples, 29 µs from chirp to chirp: λ/2T is 67 m/s.
fn fast(blocks: u32, elements: [Vec<[f64; 2]>; 2]) -> CubeHeader {
    let mut header = coded(128, blocks, elements);
    header.noise = NOISE_12_DB;
    header.radar.waveform.chirp_interval_s = 29e-6;
    header
}

fn row(places: &[f64]) -> Vec<[f64; 2]> {
    places.iter().map(|p| [*p, 0.0]).collect()
}

/// Beside as many repetitions of ideal transmitters: the echo of M chirps is added up, and so is their noise,
/// over M.
#[test]
fn codes_gain_m_over_ideal_transmitters_that_repeat_as_often() {
    for (elements, slots) in [(elements_3x4(), 4.0), (elements_6x8(), 8.0), (elements_12x16(), 16.0)] {
        let mut together = header(64, 32, elements.clone());
        let mut codes = coded(64, 32, elements);
        for header in [&mut together, &mut codes] {
            header.dsp.guard_cells = [1, 1];
            header.dsp.training_cells = [2, 2];
        }
        together.radar.waveform.chirp_interval_s = codes.radar.repetition_interval_s();
        let peak = |header: &CubeHeader| {
            let echo = cube(header, &[target([2.0, 8.0, 6.0], [0.0; 3], 1.0)], 1);
            let power =
                power_map(header, &Receiver::new(header).unwrap().range_doppler(&echo).unwrap()).unwrap();
            power.iter().copied().fold(0.0, f64::max)
        };
        let noise = |header: &CubeHeader| {
            let noisy = CubeHeader { noise: NOISE_12_DB, ..header.clone() };
            let receiver = Receiver::new(&noisy).unwrap();
            let maps = (0..8).map(|seed| receiver.range_doppler(&cube(&noisy, &[], seed)).unwrap());
            maps.map(|map| noise_power(&noisy, &map).unwrap()).sum::<f64>() / 8.0
        };
        let echo = peak(&codes) / peak(&together);
        let fall = noise(&together) / noise(&codes);
        println!(
            "{slots} slots: echo {echo:.6} of ideal transmitters', noise lower by {fall:.3}, asked {slots}"
        );
        assert!((echo - 1.0).abs() < 1e-5, "rounding of single precision: {echo}");
        // Medians of 8 maps of 2048 cells, Hann windows leave 1 cell in 2.25 independent along each axis,
        // sums of 12 channels and more: 1.25/√(8·2048/5·12) = 0.6 % each.
        assert!((fall / slots - 1.0).abs() < 0.03, "{fall}");
    }
}

#[test]
fn noise_of_codes_passes_the_detector_at_the_rate_asked_for() {
    for window in [Window::Rect, Window::Hann] {
        let mut header = coded(32, 32, [row(&[0.0, 2.0, 4.0]), row(&[0.0])]);
        header.noise = NOISE_12_DB;
        header.dsp.false_alarm_rate = 1e-2;
        (header.dsp.range_window, header.dsp.doppler_window) = (window, window);
        let receiver = Receiver::new(&header).unwrap();
        let maps = 800;
        let counts: Vec<u64> = (0..maps)
            .into_par_iter()
            .map(|seed| {
                let map = receiver.range_doppler(&cube(&header, &[], seed)).unwrap();
                map.mask.iter().filter(|m| **m == DETECTED).count() as u64
            })
            .collect();
        let rate = counts.iter().sum::<u64>() as f64 / (maps * 1024) as f64;
        println!("{window:?}: asked 1e-2, got {rate:.3e}");
        // 8000 alarms in clusters of up to 2.25² cells: 2.5 % standard deviation, four of them.
        assert!((rate / 1e-2 - 1.0).abs() < 0.1, "{rate}");
    }
}

/// Lone points of −30 to 30 m/s: found, certain, right in velocity, right in azimuth, and certain though
/// wrong.
fn points_told(header: &CubeHeader, trials: u64) -> [usize; 5] {
    let beam = dsp::angle::VirtualArray::new(header).beams()[0];
    let receiver = Receiver::new(header).unwrap();
    let outcomes: Vec<[bool; 5]> = (0..trials)
        .into_par_iter()
        .filter_map(|seed| {
            // Low-discrepancy draws of place and speed.
            let part = |step: f64| (seed as f64 * step + 0.5).fract();
            let (x, y) = (-5.0 + 15.0 * part(0.618_034), 20.0 + 20.0 * part(0.414_214));
            let target = target([x, y, 0.75], [0.0, -30.0 + 60.0 * part(0.754_878), 0.0], 10.0);
            let (range_m, velocity_mps, position_m) = truth(header, &target);
            let map = receiver.range_doppler(&cube(header, &[target], seed)).unwrap();
            let near = |o: &Object| (o.range_m - range_m).abs();
            let objects = receiver.detect(&map).unwrap().objects;
            let object = objects.into_iter().min_by(|a, b| near(a).total_cmp(&near(b)))?;
            let right = (object.radial_velocity_mps - velocity_mps).abs() < 1.0;
            let azimuth_rad = position_m[0].atan2(position_m[1]);
            // 20 dB over the noise and more leave a fraction of a beam.
            let aimed = (object.azimuth_rad.sin() - azimuth_rad.sin()).abs() < 0.25 * beam;
            let certain = object.velocity_resolved;
            Some([true, certain, right, right && aimed, certain && !(right && aimed)])
        })
        .collect();
    [0, 1, 2, 3, 4].map(|i: usize| outcomes.iter().filter(|o| o[i]).count())
}

#[test]
fn velocities_and_directions_from_minus_30_to_30_mps_are_told_by_the_codes() {
    for (name, blocks, elements, trials) in [
        ("3x4", 64, elements_3x4(), 60),
        ("6x8", 32, elements_6x8(), 30),
        ("12x16", 16, elements_12x16(), 16),
    ] {
        let header = fast(blocks, elements);
        let [found, certain, right, aimed, wrong] = points_told(&header, trials);
        println!(
            "{name}: {found} of {trials} found, {right} right in velocity, {aimed} in azimuth too, {certain} certain"
        );
        assert_eq!([found, wrong], [trials as usize, 0], "{name}");
        let directions: Vec<Direction> =
            (-8..=8).map(|i| Direction { right: 0.05 * f64::from(i), up: None }).collect();
        let lost = least_loss(&header, &directions, 1e6);
        println!("{name}: a wrong fold loses {:.2} % of the power at least", 100.0 * lost);
        // Of an even number of transmitters those of each pair exchange places half way through the folds:
        // nothing straight ahead tells.
        assert_eq!(lost < 1e-3, name != "3x4", "{name}: {lost}");
        assert!(aimed == found && 10 * certain >= 9 * found, "{name}: {certain}");
    }
}

/// Four transmitters leave no code empty, and one receiver takes every exchange of them for a direction.
#[test]
fn codes_without_an_empty_one_claim_only_what_the_receivers_tell() {
    let one_receiver = fast(48, [row(&[0.0, 1.0, 2.0, 3.0]), row(&[0.0])]);
    let [found, .., wrong] = points_told(&one_receiver, 30);
    println!("4x1: {found} of 30 found, {wrong} certain and wrong");
    assert_eq!(wrong, 0);
    let contiguous = fast(48, [row(&[0.0, 4.0, 8.0, 12.0]), row(&[0.0, 1.0, 2.0, 3.0])]);
    let [found, certain, _, aimed, wrong] = points_told(&contiguous, 40);
    println!("4x4: {found} of 40 found, {aimed} right, {certain} certain");
    assert!(found == 40 && wrong == 0 && aimed >= certain, "{certain}");
}

/// All four in phase send in one slot of a block only: no fold shows, the direction is right in all of them.
#[test]
fn straight_ahead_of_four_transmitters_no_fold_is_claimed_and_the_direction_is_right() {
    let header = fast(48, [row(&[0.0, 4.0, 8.0, 12.0]), row(&[0.0, 1.0, 2.0, 3.0])]);
    let ahead = Direction { right: 0.0, up: None };
    // Far away, where the waves are plane.
    assert!(least_loss(&header, &[ahead], 1e6) < 1e-6);
    for velocity_mps in [-25.0, -3.0, 20.0] {
        let far = target([0.0, 50.0, 6.0], [0.0, velocity_mps, 0.0], 10.0);
        let objects = Receiver::new(&header).unwrap().process(&cube(&header, &[far], 3)).unwrap().1.objects;
        let object = objects[0];
        println!(
            "{velocity_mps} m/s: shown {:.2}, azimuth {:.4} rad",
            object.radial_velocity_mps, object.azimuth_rad
        );
        assert!(!object.velocity_resolved || (object.radial_velocity_mps - velocity_mps).abs() < 0.5);
        // A beam is λ/16 half wavelengths wide, 0.125; the signal 25 dB over the noise of all channels.
        assert!(object.azimuth_rad.abs() < 0.01, "{}", object.azimuth_rad);
    }
}

/// Three transmitters: of the power that a wrong fold turns, a third goes to the code of none.
#[test]
fn a_wrong_fold_of_three_transmitters_loses_a_third_of_the_power_at_least() {
    let directions: Vec<Direction> =
        (-10..=10).map(|i| Direction { right: 0.05 * f64::from(i), up: None }).collect();
    let lost = least_loss(&fast(64, elements_3x4()), &directions, 1e6);
    println!("3x4: {:.3} of the power at least", lost);
    assert!(lost >= 1.0 / 3.0 - 1e-9, "{lost}");
}

#[test]
fn staggered_codes_are_refused() {
    let mut header = coded(32, 32, elements_3x4());
    header.radar.schedule.stagger_s = vec![0.0, 3e-6];
    assert_eq!(mapped(&header, &cube(&header, &[], 1)), Err(DspError::StaggeredDivision));
}
