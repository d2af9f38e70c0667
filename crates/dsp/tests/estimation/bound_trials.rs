//! Trials of refined estimates: their errors over the Cramér–Rao bound, of lone points and of pairs.
#![allow(clippy::unwrap_used, reason = "what cannot be measured ends the test or the study")]

use super::common::*;
use artifact::cube::CubeHeader;
use artifact::points::Point;
use artifact::seed::key;
use artifact::settings::Refine;
use dsp::Receiver;
use dsp::cramer_rao;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// Errors of one trial over the bound's standard errors: range, velocity, right, up.
type Errors = [f64; 4];

/// A small map, so that many trials are quick: the bound counts cells, whatever their number.
pub(crate) fn radar(elements: [Vec<[f64; 2]>; 2], refine: Refine) -> CubeHeader {
    let mut header = header(64, 32, elements);
    header.noise = NOISE_12_DB;
    header.dsp.refine = refine;
    header
}

/// A point at a place and speed drawn at random, of this signal-to-noise ratio per cell of one channel's
/// unwindowed map.
pub(crate) fn drawn(header: &CubeHeader, snr: f64, seed: u64) -> Target {
    let mut random = ChaCha8Rng::from_seed(key(seed, "dsp/test-estimates", &[]));
    let mut between = |low: f64, high: f64| low + (high - low) * f64::from(random.next_u32()) / 2f64.powi(32);
    let range_m = between(20.0, 45.0);
    let (u, w) = (between(-0.3, 0.3), between(-0.2, 0.2));
    let ahead = (1.0 - u * u - w * w).sqrt();
    // Radial motion: the bound's echo has no other.
    let direction = [u, ahead, w];
    let velocity_mps = between(-9.0, 9.0);
    let position_m = [0, 1, 2].map(|i: usize| header.radar.position_m[i] + range_m * direction[i]);
    let mut target = target(position_m, direction.map(|d| d * velocity_mps), 1.0);
    let (amplitude, _) = sample_cycles(header, &target, [0, 0], [0, 0]);
    let cells = f64::from(header.radar.waveform.samples * header.radar.waveform.chirps);
    target.rcs_m2 = snr * noise_variance(header) / (cells * amplitude * amplitude);
    target
}

fn errors(header: &CubeHeader, target: &Target, point: &Point, snr: f64) -> Errors {
    let bound = cramer_rao(&header.radar, snr);
    let (range_m, velocity_mps, position_m) = truth(header, target);
    let cosine =
        |at: &[f64; 3], range_m: f64, axis: usize| (at[axis] - header.radar.position_m[axis]) / range_m;
    let of_cosine =
        |axis: usize| cosine(&point.position_m, point.range_m, axis) - cosine(&position_m, range_m, axis);
    [
        (point.range_m - range_m) / bound.range_m,
        (point.radial_velocity_mps - velocity_mps) / bound.velocity_mps,
        of_cosine(0) / bound.cosines[0],
        if bound.cosines[1].is_finite() { of_cosine(2) / bound.cosines[1] } else { 0.0 },
    ]
}

/// One trial through the whole chain, beside other targets; `None` no point lies within a cell of the target.
fn trial(
    (header, receiver): (&CubeHeader, &Receiver),
    snr: f64,
    seed: u64,
    beside: &(dyn Fn(&Target) -> Vec<Target> + Sync),
) -> Option<Errors> {
    let target = drawn(header, snr, seed);
    let mut targets = beside(&target);
    targets.push(target);
    let cube = cube(header, &targets, seed);
    let map = receiver.range_doppler(&cube).unwrap();
    let points = receiver.detect_refined(&map, &cube).unwrap().points;
    let (range_m, velocity_mps, _) = truth(header, &target);
    let near = |p: &&Point| {
        (p.range_m - range_m).abs() < header.radar.waveform.range_resolution_m()
            && (p.radial_velocity_mps - velocity_mps).abs() < header.radar.velocity_resolution_mps()
    };
    points.iter().find(near).map(|point| errors(header, &target, point, snr))
}

/// Root mean square over the bound in dB for each estimate, and the share of trials that found the target.
pub(crate) fn over_bound_db(header: &CubeHeader, snr_db: f64, trials: u64) -> ([f64; 4], f64) {
    over_bound_beside_db(header, snr_db, trials, &|_| vec![])
}

fn over_bound_beside_db(
    header: &CubeHeader,
    snr_db: f64,
    trials: u64,
    beside: &(dyn Fn(&Target) -> Vec<Target> + Sync),
) -> ([f64; 4], f64) {
    let snr = 10f64.powf(0.1 * snr_db);
    let receiver = &Receiver::new(header).unwrap();
    let trial = |seed| trial((header, receiver), snr, seed, beside);
    let found: Vec<Errors> = (0..trials).into_par_iter().filter_map(trial).collect();
    let mean = |i: usize| found.iter().map(|e| e[i] * e[i]).sum::<f64>() / found.len() as f64;
    ([0, 1, 2, 3].map(|i: usize| 10.0 * mean(i).log10()), found.len() as f64 / trials as f64)
}

/// Results of trials with two equal echoes.
pub(crate) struct Pairs {
    /// Share of trials that found the first.
    pub(crate) found: f64,
    /// Share of those that refined it.
    pub(crate) refined: f64,
    /// Root mean square of the refined over the bound.
    pub(crate) over_bound_db: [f64; 4],
}

/// A second echo of equal strength, so many cells of range and velocity and beams of the array away.
pub(crate) fn pairs_refined(header: &CubeHeader, snr_db: f64, trials: u64, apart: [f64; 3]) -> Pairs {
    let snr = 10f64.powf(0.1 * snr_db);
    let mut peaks = header.clone();
    peaks.dsp.refine = Refine::Off;
    let beside = |target: &Target| vec![second(header, target, apart)];
    let [refining, peaking] = [header, &peaks].map(|header| Receiver::new(header).unwrap());
    let both = |seed: u64| {
        let refined = trial((header, &refining), snr, seed, &beside)?;
        Some((refined, trial((&peaks, &peaking), snr, seed, &beside)?))
    };
    let found: Vec<(Errors, Errors)> = (0..trials).into_par_iter().filter_map(both).collect();
    let refined: Vec<Errors> =
        found.iter().filter(|(with, without)| with != without).map(|(with, _)| *with).collect();
    let mean = |i: usize| refined.iter().map(|e| e[i] * e[i]).sum::<f64>() / refined.len() as f64;
    Pairs {
        found: found.len() as f64 / trials as f64,
        refined: refined.len() as f64 / found.len() as f64,
        over_bound_db: [0, 1, 2, 3].map(|i: usize| 10.0 * mean(i).log10()),
    }
}

/// An echo of equal power on the cube, so many cells of range and velocity and beams (λ over the virtual
/// extent) beside another.
fn second(header: &CubeHeader, target: &Target, [cells, rows, beams]: [f64; 3]) -> Target {
    let (range_m, velocity_mps, _) = truth(header, target);
    let away_m = range_m + cells * header.radar.waveform.range_resolution_m();
    let from = [0, 1, 2].map(|i: usize| target.position_m[i] - header.radar.position_m[i]);
    let start_m = from.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (sin, cos) = (beams / 6.0).asin().sin_cos();
    let direction =
        [cos * from[0] + sin * from[1], cos * from[1] - sin * from[0], from[2]].map(|x| x / start_m);
    let scale = away_m / range_m;
    let speed_mps = velocity_mps + rows * header.radar.velocity_resolution_mps();
    Target {
        position_m: [0, 1, 2].map(|i: usize| header.radar.position_m[i] + scale * start_m * direction[i]),
        velocity_mps: direction.map(|d| d * speed_mps),
        rcs_m2: target.rcs_m2 * scale.powi(4),
    }
}
