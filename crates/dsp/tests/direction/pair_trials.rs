//! Trials of two echoes in one cell: how often both are told, and how exact they are.
#![allow(clippy::unwrap_used, reason = "what cannot be measured ends the test or the study")]

use artifact::cube::CubeHeader;
use artifact::seed::key;
use dsp::angle::{Direction, VirtualArray};
use dsp::{Source, least_errors, sources};
use num_complex::Complex64;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

pub(crate) const RANGE_M: f64 = 40.0;

/// Unit noise on every channel under echoes of these amplitudes.
pub(crate) fn snapshot(
    array: &VirtualArray,
    echoes: &[(Direction, Complex64)],
    random: &mut ChaCha8Rng,
) -> Vec<Complex64> {
    let mut values: Vec<Complex64> = (0..array.excess_m(echoes[0].0, RANGE_M).len())
        .map(|_| {
            let [re, im]: [f64; 2] = std::array::from_fn(|_| StandardNormal.sample(random));
            std::f64::consts::FRAC_1_SQRT_2 * Complex64::new(re, im)
        })
        .collect();
    for (direction, amplitude) in echoes {
        let turns = array.steering(*direction, RANGE_M);
        values.iter_mut().zip(turns).for_each(|(value, turn)| *value += amplitude * turn.conj());
    }
    values
}

pub(crate) fn random(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::from_seed(key(seed, "dsp/test-super-resolution", &[]))
}

/// Two echoes of equal strength `beams` apart along an axis about a place drawn at random, any phases.
pub(crate) fn pair(
    array: &VirtualArray,
    snr_db: f64,
    axis: usize,
    beams: f64,
    random: &mut ChaCha8Rng,
) -> [(Direction, Complex64); 2] {
    let mut uniform = || f64::from(random.next_u32()) / 2f64.powi(32);
    let has_rows = array.beams()[1].is_finite();
    let centre = [uniform(), uniform()].map(|x| 0.4 * (x - 0.5));
    [-0.5, 0.5].map(|side| {
        let mut at = centre;
        at[axis] += side * beams * array.beams()[axis];
        let phase = std::f64::consts::TAU * uniform();
        let direction = Direction { right: at[0], up: has_rows.then_some(at[1]) };
        (direction, Complex64::from_polar(10f64.powf(snr_db / 20.0), phase))
    })
}

fn distance(array: &VirtualArray, a: Direction, b: Direction) -> f64 {
    let [right, up] = array.beams();
    let across = a.up.zip(b.up).map_or(0.0, |(a, b)| (a - b) / up);
    ((a.right - b.right) / right).hypot(across)
}

/// Whether two are found, each nearer to its own truth than to the other's.
fn resolves(array: &VirtualArray, truth: &[(Direction, Complex64); 2], found: &[Source]) -> bool {
    let apart = distance(array, truth[0].0, truth[1].0);
    found.len() == 2
        && truth.iter().all(|(at, _)| found.iter().any(|s| distance(array, s.direction, *at) < 0.5 * apart))
}

/// Whether the beam's FFT shows both: two strongest maxima, each nearer to its own truth.
fn fft_resolves(
    array: &VirtualArray,
    truth: &[(Direction, Complex64); 2],
    snapshot: &[Complex64],
    axis: usize,
) -> bool {
    let apart = distance(array, truth[0].0, truth[1].0);
    let step = array.beams()[axis] / 16.0;
    let at = |i: i32| match axis {
        0 => Direction { right: truth[0].0.right + f64::from(i) * step, ..truth[0].0 },
        _ => Direction { up: truth[0].0.up.map(|up| up + f64::from(i) * step), ..truth[0].0 },
    };
    let power = |i: i32| array.beam(snapshot, &array.steering(at(i), RANGE_M)).norm_sqr();
    let powers: Vec<f64> = (-48..=80).map(power).collect();
    let mut maxima: Vec<(f64, Direction)> = (1..powers.len() - 1)
        .filter(|i| powers[*i] > powers[i - 1] && powers[*i] > powers[i + 1])
        .map(|i| (powers[i], at(i as i32 - 48)))
        .collect();
    maxima.sort_by(|a, b| b.0.total_cmp(&a.0));
    truth.iter().all(|(t, _)| maxima.iter().take(2).any(|(_, m)| distance(array, *m, *t) < 0.5 * apart))
}

/// Root mean square error of pairs told apart, over their bound, dB.
pub(crate) fn over_bound_db(header: &CubeHeader, snr_db: f64, axis: usize, beams: f64, trials: u64) -> f64 {
    let array = VirtualArray::new(header);
    let errors: Vec<f64> = (0..trials)
        .into_par_iter()
        .filter_map(|seed| {
            let mut random = random(seed);
            let truth = pair(&array, snr_db, axis, beams, &mut random);
            let found = sources(&array, &snapshot(&array, &truth, &mut random), RANGE_M, 1.0);
            let bound = least_errors(&array, &truth, RANGE_M, 1.0).unwrap();
            let cosine = |d: Direction| if axis == 0 { d.right } else { d.up.unwrap() };
            let error = |(i, at): (usize, &(Direction, Complex64))| {
                let nearest = found.iter().min_by(|a, b| {
                    distance(&array, a.direction, at.0).total_cmp(&distance(&array, b.direction, at.0))
                });
                ((cosine(nearest.unwrap().direction) - cosine(at.0)) / bound[i][axis]).powi(2)
            };
            resolves(&array, &truth, &found).then(|| 0.5 * truth.iter().enumerate().map(error).sum::<f64>())
        })
        .collect();
    10.0 * (errors.iter().sum::<f64>() / errors.len() as f64).log10()
}

/// Shares of trials in which maximum likelihood and FFT tell two apart.
pub(crate) fn resolved(header: &CubeHeader, snr_db: f64, axis: usize, beams: f64, trials: u64) -> [f64; 2] {
    let array = VirtualArray::new(header);
    let outcomes: Vec<[bool; 2]> = (0..trials)
        .into_par_iter()
        .map(|seed| {
            let mut random = random(seed);
            let truth = pair(&array, snr_db, axis, beams, &mut random);
            let values = snapshot(&array, &truth, &mut random);
            [
                resolves(&array, &truth, &sources(&array, &values, RANGE_M, 1.0)),
                fft_resolves(&array, &truth, &values, axis),
            ]
        })
        .collect();
    [0, 1].map(|i: usize| outcomes.iter().filter(|o| o[i]).count() as f64 / trials as f64)
}
