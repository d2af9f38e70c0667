//! Arrays of erring elements: how they are drawn and calibrated, and what they show before and after.
#![allow(clippy::unwrap_used, reason = "what cannot be measured ends the test or the study")]

use super::common::*;
use artifact::cube::CubeHeader;
use artifact::seed::key;
use artifact::units::amplitude_from_db;
use dsp::angle::{Direction, VirtualArray};
use dsp::{Receiver, mean_errors, power_map};
use num_complex::{Complex32, Complex64};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

/// 3 dB and 30° of every element.
const SPREAD: (f64, f64) = (3.0, 30.0);

pub(crate) fn radar(elements: [Vec<[f64; 2]>; 2]) -> CubeHeader {
    let mut header = header(64, 16, elements);
    header.noise = NOISE_12_DB;
    (header.dsp.guard_cells, header.dsp.training_cells) = ([1, 1], [2, 4]);
    header
}

/// Errors of the channels, from errors of their two elements.
pub(crate) fn errors(header: &CubeHeader, seed: u64) -> Vec<Complex64> {
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
pub(crate) fn map(
    header: &CubeHeader,
    errors: &[Complex64],
    target: &Target,
    seed: u64,
) -> artifact::rdm::RdmFrame {
    let silent = CubeHeader { noise: artifact::settings::Noise::Absent, ..header.clone() };
    let (mut echo, noise) = (cube(&silent, &[*target], seed), cube(header, &[], seed));
    let length = echo.samples.len() / errors.len();
    for (i, (sample, noise)) in echo.samples.iter_mut().zip(&noise.samples).enumerate() {
        let error = errors[i / length];
        *sample = *sample * Complex32::new(error.re as f32, error.im as f32) + noise;
    }
    Receiver::new(header).unwrap().range_doppler(&echo).unwrap()
}

pub(crate) fn calibrated(header: &CubeHeader, errors: &[Complex64], seed: u64) -> CubeHeader {
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
pub(crate) fn compared(elements: [Vec<[f64; 2]>; 2], draws: u64) -> [[f64; 2]; 3] {
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
