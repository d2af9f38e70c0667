//! Velocities beyond the span of either chirp interval, told by two.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::points::{Object, PointsFrame};
use artifact::radar::Multiplexing;
use artifact::seed::key;
use dsp::Receiver;
use dsp::angle::Direction;
use dsp::least_loss;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// Two sub-frames of a waveform: 10 µs and `second_idle_s` between chirps.
fn pair(samples: u32, chirps: u32, second_idle_s: f64) -> [CubeHeader; 2] {
    [10e-6, second_idle_s].map(|idle_s| {
        let mut header = header(samples, chirps, elements_1x4());
        header.noise = NOISE_12_DB;
        header.radar.waveform.chirp_interval_s = f64::from(samples) / 5.12e6 + idle_s;
        header
    })
}

/// Both sub-frames, one after the other, with the targets where they are then; the first one's points,
/// resolved.
fn seen(headers: &[CubeHeader; 2], targets: &[Target], seed: u64) -> PointsFrame {
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

#[test]
fn x2_ten_metres_a_second_of_experiment_3_come_out_right_with_two_intervals() {
    for velocity in [10.0, -10.0] {
        let headers = pair(512, 64, 37e-6);
        let target = target([0.0, 40.0, 6.0], [0.0, velocity, 0.0], 10.0);
        let points = seen(&headers, &[target], 1);
        let (range_m, velocity_mps, _) = truth(&headers[0], &target);
        let object = points.objects[0];
        println!(
            "asked {velocity} m/s at {range_m:.3} m, got {:.4} at {:.3}",
            object.radial_velocity_mps, object.range_m
        );
        assert!(object.velocity_resolved);
        // Interpolation is good to 0.003 cells of 0.27 m/s, noise to 0.01 cells; the range is free of the
        // wrong fold's 0.11 m.
        assert!((object.radial_velocity_mps - velocity_mps).abs() < 0.01, "{object:?}");
        assert!((object.range_m - range_m).abs() < 0.01, "{object:?}");
    }
}

/// A point anywhere from −30 to 30 m/s.
fn isolated(seed: u64) -> Target {
    let mut between = random(seed);
    target([between(-8.0, 8.0), between(20.0, 55.0), 0.75], [0.0, between(-30.0, 30.0), 0.0], 1.0)
}

fn isolated_is_right(headers: &[CubeHeader; 2], seed: u64) -> bool {
    let target = isolated(seed);
    let (range_m, velocity_mps, _) = truth(&headers[0], &target);
    let points = seen(headers, &[target], seed);
    nearest(&points, range_m, velocity_mps)
        .is_some_and(|o| (o.radial_velocity_mps - velocity_mps).abs() < 1.0)
}

/// Vehicles of several scatterers, each at a speed of its own, and how many come out right, how many are said
/// to be certain and wrong.
fn vehicles_right(headers: &[CubeHeader; 2], count: usize, seed: u64) -> [usize; 2] {
    let vehicles = vehicles(&headers[0], count, seed);
    let targets: Vec<Target> = vehicles.iter().flat_map(|v| v.0.clone()).collect();
    right_of(&seen(headers, &targets, seed), &vehicles)
}

/// Scatterers of a vehicle, and the strength-weighted means of their ranges and radial velocities.
type Vehicle = (Vec<Target>, f64, f64);

/// At speeds of their own, beside each other.
fn vehicles(header: &CubeHeader, count: usize, seed: u64) -> Vec<Vehicle> {
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

fn right_of(points: &PointsFrame, vehicles: &[Vehicle]) -> [usize; 2] {
    let right = |(_, range_m, velocity_mps): &&Vehicle| {
        nearest(points, *range_m, *velocity_mps)
            .is_some_and(|o| (o.radial_velocity_mps - velocity_mps).abs() < 1.5)
    };
    let is_of = |o: &Object| vehicles.iter().any(|v| (o.radial_velocity_mps - v.2).abs() < 1.5);
    let wrong = points.objects.iter().filter(|o| o.velocity_resolved && !is_of(o)).count();
    [vehicles.iter().filter(right).count(), wrong]
}

#[test]
fn velocities_from_minus_30_to_30_come_out_right() {
    let headers = pair(256, 64, 25e-6);
    let isolated = (0..60_u64).into_par_iter().filter(|seed| isolated_is_right(&headers, *seed)).count();
    let lone: Vec<[usize; 2]> =
        (0..12_u64).into_par_iter().map(|seed| vehicles_right(&headers, 1, seed)).collect();
    let two: Vec<[usize; 2]> =
        (0..12_u64).into_par_iter().map(|seed| vehicles_right(&headers, 2, seed)).collect();
    let sum = |all: &[[usize; 2]]| all.iter().map(|t| t[0]).sum::<usize>();
    println!(
        "right: {isolated} of 60 points, {} of 12 vehicles, {} of 24 that share range cells",
        sum(&lone),
        sum(&two)
    );
    assert_eq!(isolated, 60);
    assert_eq!(sum(&lone), 12);
    // 95 % asked; of 24 at that rate fewer than 20 are right in 0.5 % of all draws.
    assert!(sum(&two) >= 20);
}

/// Three transmitters in turn on 3 × 4 elements or others: 128 samples, 29 µs from chirp to chirp, so that
/// λ/2T is 67 m/s.
fn in_turn(elements: [Vec<[f64; 2]>; 2]) -> CubeHeader {
    let mut header = header(128, 64, elements);
    header.noise = NOISE_12_DB;
    header.radar.waveform.chirp_interval_s = 29e-6;
    header.radar.array.multiplexing = Multiplexing::Tdm;
    header
}

/// Experiment 1's sub-frames, 3 × 4 in turn.
fn in_turn_twice() -> [CubeHeader; 2] {
    pair(256, 64, 25e-6).map(|mut header| {
        header.radar.array = in_turn(elements_3x4()).radar.array;
        header
    })
}

fn seen_once(header: &CubeHeader, targets: &[Target], seed: u64) -> PointsFrame {
    Receiver::new(header).unwrap().process(&cube(header, targets, seed)).unwrap().1
}

/// Of lone points: how many are detected, certain, right, right of the certain.
fn folds_of_points(header: &CubeHeader, trials: u64) -> [usize; 4] {
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

/// Of vehicles side by side, by time division alone: right, certain and wrong.
fn folds_of_vehicles(header: &CubeHeader, count: usize, seed: u64) -> [usize; 2] {
    let vehicles = vehicles(header, count, seed);
    let targets: Vec<Target> = vehicles.iter().flat_map(|v| v.0.clone()).collect();
    right_of(&seen_once(header, &targets, seed), &vehicles)
}

#[test]
fn velocities_from_minus_30_to_30_are_told_by_the_phases_between_transmitters() {
    for (name, elements) in [("3x4", elements_3x4()), ("6x8", elements_6x8())] {
        let [found, certain, right, certain_right] = folds_of_points(&in_turn(elements), 60);
        println!(
            "{name}: {found} of 60 found, {right} right, {certain} certain, {certain_right} of them right"
        );
        assert!(found == 60 && certain_right == certain, "{name}");
        // A wrong fold of 3 × 4 loses 30 % of the beam, of 6 × 8 6 %: the weakest points, at 55 m, are 14 dB
        // over a channel's noise.
        assert!(certain >= 57, "{name}: {certain}");
    }
}

#[test]
fn transmitters_in_turn_with_two_intervals_tell_what_each_alone_cannot() {
    let headers = in_turn_twice();
    let right = (0..24_u64).into_par_iter().filter(|seed| isolated_is_right(&headers, *seed)).count();
    println!("{right} of 24 right, λ/2T 32.5 and 26 m/s, spans of the maps 10.8 and 8.7 m/s");
    assert_eq!(right, 24);
}

#[test]
fn an_array_whose_wrong_folds_are_other_directions_claims_nothing() {
    // One receiver: a turn from transmitter to transmitter is a direction, exactly.
    let row = |places: &[f64]| places.iter().map(|p| [*p, 0.0]).collect::<Vec<_>>();
    let header = in_turn([row(&[0.0, 1.0, 2.0, 3.0]), row(&[0.0])]);
    let [found, certain, ..] = folds_of_points(&header, 30);
    println!("4x1: {found} of 30 found, {certain} certain");
    assert!(found > 25 && certain == 0);
}

#[test]
fn what_a_wrong_fold_loses_is_the_receivers_pattern_at_the_turn() {
    let ahead = Direction { right: 0.0, up: None };
    let lost = least_loss(&in_turn(elements_3x4()), &[ahead], 1e6);
    // 3 × 4 contiguous: a fold turns the row of transmitters by a third of a cycle, over 2 λ to u = 1/6; the
    // receivers look ahead.
    let row_of =
        |count: f64, x: f64| if x == 0.0 { 1.0 } else { ((count * x).sin() / (count * x.sin())).powi(2) };
    let kept = |u: f64| {
        row_of(3.0, std::f64::consts::TAU * (u - 1.0 / 6.0)) * row_of(4.0, 0.5 * std::f64::consts::PI * u)
    };
    let most = (0..10_000).map(|i| kept(f64::from(i) / 30_000.0)).fold(0.0, f64::max);
    println!("3x4 keeps {:.5}, by the rows' patterns {most:.5} ({:.2} dB)", 1.0 - lost, 10.0 * most.log10());
    // Steps of 3e-5 beside a maximum of curvature 200 leave 1e-7; the climb stops within 1e-4 of u.
    assert!((1.0 - lost - most).abs() < 2e-6);
    let row = |places: &[f64]| places.iter().map(|p| [*p, 0.0]).collect::<Vec<_>>();
    assert!(least_loss(&in_turn([row(&[0.0, 1.0, 2.0, 3.0]), row(&[0.0])]), &[ahead], 1e6) < 1e-6);
}

/// Writes `docs/validation/ambiguity.md`.
#[test]
#[ignore = "some minutes"]
fn study_of_velocities_beyond_the_span() {
    let mut page = String::from(PREAMBLE);
    for (name, samples, idle_s) in
        [("experiment 1, 60 and 75 µs", 256, 25e-6), ("experiment 3, 110 and 137 µs", 512, 37e-6)]
    {
        let headers = pair(samples, 64, idle_s);
        let points = if samples == 256 { 3000 } else { 1500 };
        let isolated = (0..points).into_par_iter().filter(|seed| isolated_is_right(&headers, *seed)).count();
        row(&mut page, name, "lone points", isolated, points as usize, None);
        for (what, count, trials) in [("vehicles", 1, 300), ("vehicles, two in the same range cells", 2, 300)]
        {
            let all: Vec<[usize; 2]> = (0..trials)
                .into_par_iter()
                .map(|seed| vehicles_right(&headers, count, 1000 + seed))
                .collect();
            let sum = |i: usize| all.iter().map(|t| t[i]).sum::<usize>();
            row(&mut page, name, what, sum(0), count * trials as usize, Some(sum(1)));
        }
    }
    page.push_str(CHAIN);
    std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/validation/ambiguity.md"), page).unwrap();
}

/// Writes `docs/validation/transmitters-in-turn.md`.
#[test]
#[ignore = "some minutes"]
fn in_turn_study() {
    let mut page = String::from(IN_TURN);
    arrays_in_turn(&mut page);
    page.push_str(VEHICLES_IN_TURN);
    vehicles_in_turn(&mut page);
    std::fs::write(
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/validation/transmitters-in-turn.md"),
        page,
    )
    .unwrap();
}

/// What arrays can tell, and what they told of lone points.
fn arrays_in_turn(page: &mut String) {
    let row = |places: &[f64]| places.iter().map(|p| [*p, 0.0]).collect::<Vec<_>>();
    let directions: Vec<Direction> =
        (-10..=10).map(|i| Direction { right: 0.05 * f64::from(i), up: None }).collect();
    for (name, elements, trials) in [
        ("2x4: 0, 4", [row(&[0.0, 4.0]), row(&[0.0, 1.0, 2.0, 3.0])], 300),
        ("3x4: 0, 4, 8", elements_3x4(), 1000),
        ("3x4, one overlapping: 0, 3, 6", [row(&[0.0, 3.0, 6.0]), row(&[0.0, 1.0, 2.0, 3.0])], 300),
        (
            "3x4, wide receivers: 0, 1, 2 by 0, 3, 6, 9",
            [row(&[0.0, 1.0, 2.0]), row(&[0.0, 3.0, 6.0, 9.0])],
            300,
        ),
        ("6x8 with elevation", elements_6x8(), 300),
        ("12x16", elements_12x16(), 40),
        ("4x1: 0, 1, 2, 3", [row(&[0.0, 1.0, 2.0, 3.0]), row(&[0.0])], 300),
    ] {
        let mut header = in_turn(elements);
        let slots = header.radar.array.tx_m.len() as u32;
        header.radar.waveform.chirps = (192 / slots).max(32);
        let lost = least_loss(&header, &directions, 40.0);
        let [found, certain, right, certain_right] = folds_of_points(&header, trials);
        let line = format!(
            "| {name} | {:.1} % | {found} | {:.2} % | {:.2} % | {} |\n",
            100.0 * lost,
            100.0 * right as f64 / found as f64,
            100.0 * certain as f64 / found as f64,
            certain - certain_right
        );
        print!("{line}");
        page.push_str(&line);
    }
}

fn vehicles_in_turn(page: &mut String) {
    let all_of = |right: &(dyn Fn(u64) -> [usize; 2] + Sync)| {
        let all: Vec<[usize; 2]> = (1000..1060_u64).into_par_iter().map(right).collect();
        [0, 1].map(|i: usize| all.iter().map(|t| t[i]).sum::<usize>())
    };
    for (name, elements) in [("3x4, 29 µs", elements_3x4()), ("6x8, 29 µs", elements_6x8())] {
        let header = in_turn(elements);
        for (what, count) in [("vehicles", 1), ("vehicles, two in the same range cells", 2)] {
            let [right, wrong] = all_of(&|seed| folds_of_vehicles(&header, count, seed));
            row(page, name, what, right, count * 60, Some(wrong));
        }
    }
    let (name, headers) = ("3x4, 60 and 75 µs", in_turn_twice());
    let lone = (0..500_u64).into_par_iter().filter(|seed| isolated_is_right(&headers, *seed)).count();
    row(page, name, "lone points", lone, 500, None);
    for (what, count) in [("vehicles", 1), ("vehicles, two in the same range cells", 2)] {
        let [right, wrong] = all_of(&|seed| vehicles_right(&headers, count, seed));
        row(page, name, what, right, count * 60, Some(wrong));
    }
}

fn row(page: &mut String, name: &str, what: &str, right: usize, all: usize, wrong: Option<usize>) {
    let share = 100.0 * right as f64 / all as f64;
    let wrong = wrong.map_or("–".to_owned(), |n| n.to_string());
    let line = format!("| {name} | {what} | {all} | {share:.2} % | {wrong} |\n");
    print!("{line}");
    page.push_str(&line);
}

const PREAMBLE: &str = "# Velocities beyond the span

Two sub-frames of 64 chirps, one after the other, whose chirp intervals differ; 1 × 4 elements, noise figure 12 dB, Hann windows, the whole chain. Speeds
are drawn from −30 to 30 m/s along the road, lanes from x = 2 to 9.5 m, 25–50 m away (points 20–55 m). Vehicles are boxes of 26 to 144 point scatterers (2.2, 4.5 or
12 m long) with strengths spread as exponentials; two vehicles stand beside each other, within 1 m of the same distance, each with its own speed.
*Right*: an object within 4 m of the vehicle's range has its radial velocity within 1.5 m/s (points 1 m/s); the spans differ by 6.5 and 3.5 m/s,
so a wrong fold is far outside. *Certain and wrong*: objects that say `velocity_resolved` with a velocity that no vehicle has.

`cargo test --release -p dsp --test estimation -- --ignored --nocapture velocity_folds::study` writes this page.

| waveform | targets | number | right | certain and wrong |
|---|---|---|---|---|
";

const IN_TURN: &str = "# Transmitters in turn: velocity folds told by the phases between them

N transmitters in turn, each repeated after N·T, show velocities up to multiples of λ/2NT. With k multiples too many, 2πk/N is left between one transmitter
and the next. Every fold is tried on a cell: the one whose strongest beam leaves least of the cell's power is taken (generalised likelihood ratio of one echo in white noise; over an object its cells
together), and it is *certain* if the next one is behind by 9 in the logarithm of the likelihood, what even the best fold leaves counted as noise (`crates/dsp/src/ambiguity/time_division_folds.rs`). What remains is the
ambiguity of a single transmitter, λ/2T: `velocity_resolved` is only said where that is beyond 33.4 m/s too, or two sub-frames tell it.

How well that works is the array's. *A wrong fold loses*: the least part of the power, over all folds and directions up to u = ±0.5. With one receiver and a regular row of transmitters a wrong fold **is** another direction: nothing tells,
and nothing is claimed; so it is where receivers stand N transmitter spacings apart. Contiguous arrays lose about 3/N² (the receivers' own beam is as wide as the transmitters' grating lobes are apart): 3 × 4 keeps 1.4 dB to tell by, 12 × 16 0.1 dB. Two elements of the virtual array in one place help.

Lone points of −30 to 30 m/s along the road, 20–55 m away, noise figure 12 dB, 128 samples, T = 29 µs (λ/2T = 67 m/s), 192/N chirps of each transmitter, at least 32. *Right*: within 1 m/s; the folds are 67/N m/s apart.

`cargo test --release -p dsp --test estimation -- --ignored --nocapture in_turn_study` writes this page.

| array: transmitters by receivers, λ/2 | a wrong fold loses | found | right | certain | certain and wrong |
|---|---|---|---|---|---|
";

const VEHICLES_IN_TURN: &str = "
Vehicles as in [ambiguity](ambiguity.md), 64 chirps of each transmitter; at 29 µs one frame alone, at 60 and 75 µs two sub-frames, whose maps span 10.8 and 8.7 m/s and whose λ/2T are 32.5 and 26 m/s. Several echoes in a cell fit no fold well.

| array | targets | number | right | certain and wrong |
|---|---|---|---|---|
";

const CHAIN: &str = "
Transmitters in turn have their own folds, told by the phases between them: [transmitters in turn](transmitters-in-turn.md).

In the whole chain: `cargo xtask run scenes/experiment-3-two-intervals.toml`, the car of experiment 3 by 110 and 137 µs: −9.801 m/s in both sub-frames (the echo's −9.801 and −9.800; the body's −9.790), map abnormal, velocity resolved;
`experiment-3.toml` with one interval shows +7.752 m/s.
";
