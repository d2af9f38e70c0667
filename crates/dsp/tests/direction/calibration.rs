//! Arrays of erring elements, before and after their calibration on a reflector.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::cube::CubeHeader;
use artifact::seed::key;
use artifact::units::amplitude_from_db;
use dsp::angle::{Direction, VirtualArray};
use dsp::{DspError, Receiver, mean_errors, power_map};
use num_complex::{Complex32, Complex64};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use std::fmt::Write;

/// 3 dB and 30° of every element.
const SPREAD: (f64, f64) = (3.0, 30.0);

fn radar(elements: [Vec<[f64; 2]>; 2]) -> CubeHeader {
    let mut header = header(64, 16, elements);
    header.noise = NOISE_12_DB;
    (header.dsp.guard_cells, header.dsp.training_cells) = ([1, 1], [2, 4]);
    header
}

/// Of the channels, from errors of their two elements.
fn errors(header: &CubeHeader, seed: u64) -> Vec<Complex64> {
    let mut random = ChaCha8Rng::from_seed(key(seed, "dsp/test-elements", &[]));
    let mut element = || {
        let (gain, phase): (f64, f64) =
            (StandardNormal.sample(&mut random), StandardNormal.sample(&mut random));
        Complex64::from_polar(amplitude_from_db(SPREAD.0 * gain), (SPREAD.1 * phase).to_radians())
    };
    let array = &header.radar.array;
    let [tx, rx]: [Vec<Complex64>; 2] =
        [array.tx_m.len(), array.rx_m.len()].map(|n| (0..n).map(|_| element()).collect());
    tx.iter().flat_map(|t| rx.iter().map(move |r| t * r)).collect()
}

/// The map of a point in noise, heard by channels with these errors.
fn map(header: &CubeHeader, errors: &[Complex64], target: &Target, seed: u64) -> artifact::rdm::RdmFrame {
    let silent = CubeHeader { noise: artifact::settings::Noise::Absent, ..header.clone() };
    let (mut echo, noise) = (cube(&silent, &[*target], seed), cube(header, &[], seed));
    let length = echo.samples.len() / errors.len();
    for (i, (sample, noise)) in echo.samples.iter_mut().zip(&noise.samples).enumerate() {
        let error = errors[i / length];
        *sample = *sample * Complex32::new(error.re as f32, error.im as f32) + noise;
    }
    Receiver::new(header).unwrap().range_doppler(&echo).unwrap()
}

fn calibrated(header: &CubeHeader, errors: &[Complex64], seed: u64) -> CubeHeader {
    let reflector = target([1.0, 12.0, 5.0], [0.0; 3], 100.0);
    let frames: Vec<Vec<Complex64>> = (0..4)
        .map(|frame| {
            Receiver::new(header).and_then(|receiver| {
                receiver.channel_errors(
                    &map(header, errors, &reflector, 1000 * seed + frame),
                    reflector.position_m,
                )
            })
        })
        .collect::<Result<_, _>>()
        .unwrap();
    let mut header = header.clone();
    header.dsp.calibration = mean_errors(&frames).iter().map(|error| 1.0 / error).collect();
    header
}

/// Error of the direction cosine in beams, and the highest sidelobe under the peak, dB.
fn seen(header: &CubeHeader, errors: &[Complex64], direction: f64, seed: u64) -> [f64; 2] {
    let target =
        target([14.0 * direction, 14.0 * (1.0 - direction * direction).sqrt(), 6.0], [0.0; 3], 100.0);
    let map = map(header, errors, &target, seed);
    let array = VirtualArray::new(header);
    let power = power_map(header, &map).unwrap();
    let (cell, _) =
        power.indexed_iter().fold(((0, 0), 0.0), |best, (at, p)| if *p > best.1 { (at, *p) } else { best });
    let snapshot = array.snapshot(&map, [cell.0, cell.1], 0.0);
    let found = array.direction(std::slice::from_ref(&snapshot), 14.0).right;
    let (beam, up) = (array.beams()[0], Some(0.0));
    let level = |right: f64| array.beam(&snapshot, &array.steering(Direction { right, up }, 14.0)).norm_sqr();
    // Beyond the first zeros, a beam aside.
    let aside = (-4000..=4000).map(|i| f64::from(i) / 4000.0).filter(|u| (u - found).abs() > beam);
    let highest = aside.map(level).fold(0.0, f64::max);
    [(found - direction) / beam, 10.0 * (highest / level(found)).log10()]
}

/// Root mean square of direction errors in beams, mean of the highest sidelobes in dB: ideal, erring,
/// calibrated.
fn compared(elements: [Vec<[f64; 2]>; 2], draws: u64) -> [[f64; 2]; 3] {
    let header = radar(elements);
    let ideal = vec![Complex64::ONE; header.radar.virtual_channels()];
    let directions = [-0.6, -0.25, 0.0, 0.37, 0.5];
    let of_draw = |draw: u64| {
        let errors = errors(&header, draw);
        let known = calibrated(&header, &errors, draw);
        let of = |header: &CubeHeader, errors: &[Complex64]| {
            let all = directions.map(|u| seen(header, errors, u, draw));
            [all.iter().map(|s| s[0] * s[0]).sum::<f64>() / 5.0, all.iter().map(|s| s[1]).sum::<f64>() / 5.0]
        };
        [of(&header, &ideal), of(&header, &errors), of(&known, &errors)]
    };
    let all: Vec<[[f64; 2]; 3]> = (0..draws).into_par_iter().map(of_draw).collect();
    [0, 1, 2].map(|case: usize| {
        let mean = |i: usize| all.iter().map(|draw| draw[case][i]).sum::<f64>() / draws as f64;
        [mean(0).sqrt(), mean(1)]
    })
}

#[test]
fn a_calibrated_array_of_erring_elements_is_as_good_as_an_ideal_one() {
    for (name, elements, draws) in [("3x4", elements_3x4(), 24), ("12x16", elements_12x16(), 3)] {
        let [ideal, erring, calibrated] = compared(elements, draws);
        println!(
            "{name}: ideal {ideal:.4?}, 3 dB and 30° {erring:.4?}, calibrated {calibrated:.4?} (beams rms, dB)"
        );
        // The reflector is 25 dB over a channel's noise in four frames and more: 2° and 0.3 dB of a channel,
        // a fifteenth of what was.
        assert!(calibrated[0] < 0.2 * erring[0] && (calibrated[1] - ideal[1]).abs() < 0.7, "{name}");
        assert!(erring[1] > ideal[1] + 2.0, "{name}: errors raise sidelobes");
    }
}

#[test]
fn points_of_a_calibrated_array_stand_in_their_direction() {
    let header = radar(elements_3x4());
    let errors = errors(&header, 7);
    let known = calibrated(&header, &errors, 7);
    // At the assumed height: without elevation rows the azimuth follows from it.
    let target = target([-4.0, 12.0, 0.75], [0.0; 3], 100.0);
    let points = Receiver::new(&known).unwrap().detect(&map(&known, &errors, &target, 9)).unwrap().points;
    let missed = points[0].azimuth_rad - (-4.0_f64).atan2(12.0);
    println!("off by {missed:.4} rad of a beam of 0.17");
    assert!(missed.abs() < 0.01);
}

#[test]
fn calibrations_that_do_not_fit_and_reflectors_that_are_not_there_are_refused() {
    let header = radar(elements_3x4());
    let ideal = vec![Complex64::ONE; 12];
    let reflector = target([1.0, 12.0, 5.0], [0.0; 3], 100.0);
    let map = map(&header, &ideal, &reflector, 1);
    assert!(matches!(
        Receiver::new(&header).and_then(|receiver| receiver.channel_errors(&map, [0.0, 70.0, 6.0])),
        Err(DspError::ReflectorRange { .. })
    ));
    assert!(matches!(
        Receiver::new(&header).and_then(|receiver| receiver.channel_errors(&map, [0.0, f64::NAN, 6.0])),
        Err(DspError::ReflectorRange { .. })
    ));
    assert!(matches!(
        Receiver::new(&header).and_then(|receiver| receiver.channel_errors(&map, [0.0, 6.0, 6.0])),
        Err(DspError::WeakReflector { .. })
    ));
    let mut short = header;
    short.dsp.calibration = vec![Complex64::ONE; 11];
    assert_eq!(
        Receiver::new(&short).and_then(|receiver| receiver.detect(&map)),
        Err(DspError::Calibration { expected: 12, found: 11 })
    );
}

/// Writes `docs/validation/calibration.md`.
#[test]
#[ignore = "a minute"]
fn study_of_erring_elements() {
    let mut page = String::from(PREAMBLE);
    for (name, elements, draws) in [("3 × 4", elements_3x4(), 400), ("12 × 16", elements_12x16(), 24)] {
        let cases = compared(elements, draws);
        for (what, [beams, sidelobe_db]) in ["ideal", "3 dB, 30°", "calibrated"].into_iter().zip(cases) {
            writeln!(page, "| {name} | {what} | {} | {beams:.4} | {sidelobe_db:.1} |", 5 * draws).unwrap();
        }
    }
    print!("{page}");
    std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/validation/calibration.md"), page)
        .unwrap();
}

const PREAMBLE: &str = "# Erring elements, before and after calibration

Every transmit and receive element has a gain and a phase of its own, normal with 3 dB and 30°. They are measured as
`cargo xtask calibrate` does: on four frames of a reflector of 20 dBsm at rest 12 m away, by its known place. A point of 20 dBsm is then looked for 14 m away, in direction
cosines −0.6, −0.25, 0, 0.37 and 0.5; noise figure 12 dB, 64 samples, 16 chirps, Hann windows. *Direction*: error of the strongest beam, root mean square, in
beams (λ over the aperture: 9.5° of 3 × 4, 0.6° of 12 × 16). *Sidelobe*: the highest beyond the first zeros, under the peak, mean of dB; unweighted arrays have −13.

`cargo test --release -p dsp --test direction -- --ignored --nocapture calibration::study` writes this page.

| array | elements | points | direction, beams | sidelobe, dB |
|---|---|---|---|---|
";
