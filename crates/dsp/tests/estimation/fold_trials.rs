//! Trials of velocities beyond the span: points and vehicles by two chirp intervals, and by transmitters in
//! turn.
#![allow(clippy::unwrap_used, reason = "what cannot be measured ends the test or the study")]

use super::common::*;
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::points::{Object, PointsFrame};
use artifact::radar::Multiplexing;
use artifact::seed::key;
use dsp::Receiver;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// Two sub-frames of a waveform: 10 µs and `second_idle_s` between chirps.
pub(crate) fn pair(samples: u32, chirps: u32, second_idle_s: f64) -> [CubeHeader; 2] {
    [10e-6, second_idle_s].map(|idle_s| {
        let mut header = header(samples, chirps, elements_1x4());
        header.noise = NOISE_12_DB;
        header.radar.waveform.chirp_interval_s = f64::from(samples) / 5.12e6 + idle_s;
        header
    })
}

/// Both sub-frames, one after the other, with the targets where they are then; the first one's points,
/// resolved.
pub(crate) fn seen(headers: &[CubeHeader; 2], targets: &[Target], seed: u64) -> PointsFrame {
    let start_s = [0.0, headers[0].radar.frame_duration_s()];
    let mut header = headers[0].clone();
    header.radar.schedule.sub_frame_intervals_s =
        headers.iter().map(|own| own.radar.waveform.chirp_interval_s).collect();
    let receiver = Receiver::new(&header).unwrap();
    let frames = [0, 1].map(|i: usize| {
        let moved: Vec<Target> = (targets.iter())
            .map(|t| Target {
                position_m: [0, 1, 2].map(|a: usize| t.position_m[a] + start_s[i] * t.velocity_mps[a]),
                ..*t
            })
            .collect();
        let samples = cube(&headers[i], &moved, 2 * seed + i as u64);
        receiver.process(&CubeFrame { index: i as u32, time_s: start_s[i], ..samples }).unwrap().1
    });
    receiver.resolved(frames.into()).remove(0)
}

/// The object nearest in range within 4 m, and among those the one nearest in velocity.
fn nearest(points: &PointsFrame, range_m: f64, velocity_mps: f64) -> Option<&Object> {
    let near = points.objects.iter().filter(|o| (o.range_m - range_m).abs() < 4.0);
    near.min_by(|a, b| {
        let off = |o: &Object| (o.radial_velocity_mps - velocity_mps).abs();
        off(a).total_cmp(&off(b))
    })
}

fn random(seed: u64) -> impl FnMut(f64, f64) -> f64 {
    let mut random = ChaCha8Rng::from_seed(key(seed, "dsp/test-velocity-folds", &[]));
    move |low, high| low + (high - low) * f64::from(random.next_u32()) / 2f64.powi(32)
}

/// A point anywhere from −30 to 30 m/s.
fn isolated(seed: u64) -> Target {
    let mut between = random(seed);
    target([between(-8.0, 8.0), between(20.0, 55.0), 0.75], [0.0, between(-30.0, 30.0), 0.0], 1.0)
}

pub(crate) fn isolated_is_right(headers: &[CubeHeader; 2], seed: u64) -> bool {
    let target = isolated(seed);
    let (range_m, velocity_mps, _) = truth(&headers[0], &target);
    let points = seen(headers, &[target], seed);
    nearest(&points, range_m, velocity_mps)
        .is_some_and(|o| (o.radial_velocity_mps - velocity_mps).abs() < 1.0)
}

/// Vehicles of several scatterers, each at a speed of its own, and how many come out right, how many are said
/// to be certain and wrong.
pub(crate) fn vehicles_right(headers: &[CubeHeader; 2], count: usize, seed: u64) -> [usize; 2] {
    let vehicles = vehicles(&headers[0], count, seed);
    let targets: Vec<Target> = vehicles.iter().flat_map(|v| v.0.clone()).collect();
    right_of(&seen(headers, &targets, seed), &vehicles)
}

/// Scatterers of a vehicle, and the strength-weighted means of their ranges and radial velocities.
pub(crate) type Vehicle = (Vec<Target>, f64, f64);

/// Vehicles at speeds of their own, beside each other.
pub(crate) fn vehicles(header: &CubeHeader, count: usize, seed: u64) -> Vec<Vehicle> {
    let mut between = random(seed);
    let y = between(25.0, 50.0);
    (0..count)
        .map(|i| {
            let size = [[4.5, 1.8, 1.5], [12.0, 2.5, 3.0], [2.2, 0.8, 1.3]][between(0.0, 3.0) as usize];
            // Sharing range cells: beside each other, a lane between them.
            let at = [[2.0, 9.5, 5.75][i], y + between(-1.0, 1.0)];
            let speed = between(-30.0, 30.0);
            let points = vehicle(at, size, speed, 7 * seed + i as u64);
            let power: f64 = points.iter().map(|p| p.rcs_m2).sum();
            let mean =
                |f: &dyn Fn(&Target) -> f64| points.iter().map(|p| p.rcs_m2 * f(p)).sum::<f64>() / power;
            let (range_m, velocity_mps) = (mean(&|p| truth(header, p).0), mean(&|p| truth(header, p).1));
            (points, range_m, velocity_mps)
        })
        .collect()
}

pub(crate) fn right_of(points: &PointsFrame, vehicles: &[Vehicle]) -> [usize; 2] {
    let right = |(_, range_m, velocity_mps): &&Vehicle| {
        nearest(points, *range_m, *velocity_mps)
            .is_some_and(|o| (o.radial_velocity_mps - velocity_mps).abs() < 1.5)
    };
    let is_of = |o: &Object| vehicles.iter().any(|v| (o.radial_velocity_mps - v.2).abs() < 1.5);
    let wrong = points.objects.iter().filter(|o| o.velocity_resolved && !is_of(o)).count();
    [vehicles.iter().filter(right).count(), wrong]
}

/// Three transmitters in turn on 3 × 4 elements or others: 128 samples, 29 µs from chirp to chirp, so that
/// λ/2T is 67 m/s.
pub(crate) fn in_turn(elements: [Vec<[f64; 2]>; 2]) -> CubeHeader {
    let mut header = header(128, 64, elements);
    header.noise = NOISE_12_DB;
    header.radar.waveform.chirp_interval_s = 29e-6;
    header.radar.array.multiplexing = Multiplexing::Tdm;
    header
}

/// Experiment 1's sub-frames, 3 × 4 in turn.
pub(crate) fn in_turn_twice() -> [CubeHeader; 2] {
    pair(256, 64, 25e-6).map(|mut header| {
        header.radar.array = in_turn(elements_3x4()).radar.array;
        header
    })
}

pub(crate) fn seen_once(header: &CubeHeader, targets: &[Target], seed: u64) -> PointsFrame {
    Receiver::new(header).unwrap().process(&cube(header, targets, seed)).unwrap().1
}

/// Numbers of lone points that are detected, certain, right, and right and certain.
pub(crate) fn folds_of_points(header: &CubeHeader, trials: u64) -> [usize; 4] {
    let outcomes: Vec<[bool; 4]> = (0..trials)
        .into_par_iter()
        .filter_map(|seed| {
            let target = isolated(seed);
            let (range_m, velocity_mps, _) = truth(header, &target);
            let points = seen_once(header, &[target], seed);
            let object = nearest(&points, range_m, velocity_mps)?;
            let right = (object.radial_velocity_mps - velocity_mps).abs() < 1.0;
            Some([true, object.velocity_resolved, right, right && object.velocity_resolved])
        })
        .collect();
    [0, 1, 2, 3].map(|i: usize| outcomes.iter().filter(|o| o[i]).count())
}
