//! Velocities beyond the span of either chirp interval, told by two.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use crate::fold_trials::{
    folds_of_points, in_turn, in_turn_twice, isolated_is_right, pair, seen, vehicles_right,
};
use artifact::radar::Multiplexing;
use dsp::angle::Direction;
use dsp::least_loss;
use rayon::prelude::*;

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
fn doppler_division_with_two_intervals_tells_velocities_beyond_its_span() {
    // Spans of 32.3 and 25.8 m/s.
    let headers = in_turn_twice().map(|mut header| {
        header.radar.array.multiplexing = Multiplexing::Ddm;
        header
    });
    let right = (0..24_u64).into_par_iter().filter(|seed| isolated_is_right(&headers, *seed)).count();
    println!("{right} of 24 right");
    assert_eq!(right, 24);
    for velocity in [-29.0, 20.0] {
        let points = seen(&headers, &[target([0.0, 40.0, 6.0], [0.0, velocity, 0.0], 10.0)], 1);
        let object = points.objects[0];
        assert!(
            object.velocity_resolved && (object.radial_velocity_mps - velocity).abs() < 0.05,
            "{object:?}"
        );
    }
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
