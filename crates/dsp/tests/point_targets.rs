//! What the chain says of point targets whose truth is known.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use artifact::cube::CubeHeader;
use artifact::points::PointsFrame;
use common::*;
use dsp::{detect, power_map, range_axis_m, range_doppler, velocity_axis_mps};

fn seen(header: &CubeHeader, targets: &[Target]) -> PointsFrame {
    detect(header, &range_doppler(header, &cube(header, targets, 1)).unwrap()).unwrap()
}

/// Cell of a map's peak as (velocity, range) on the axes.
fn peak(header: &CubeHeader, targets: &[Target]) -> (f64, f64) {
    let map = range_doppler(header, &cube(header, targets, 1)).unwrap();
    let power = power_map(header, &map).unwrap();
    let (cell, _) = power.indexed_iter().fold(((0, 0), 0.0), |best, (at, p)| if *p > best.1 { (at, *p) } else { best });
    (velocity_axis_mps(header)[cell.0], range_axis_m(header)[cell.1])
}

#[test]
fn an_approaching_target_lands_in_negative_doppler() {
    let header = header(256, 128, elements_1x1());
    let (velocity, range) = peak(&header, &[target([0.0, 30.0, 6.0], [0.0, -10.0, 0.0], 1.0)]);
    assert!((velocity + 10.0).abs() <= 0.5 * header.radar.velocity_resolution_mps());
    assert!((range - 30.0).abs() <= header.radar.waveform.range_resolution_m());
}

#[test]
fn a_receding_target_of_ten_mps_shows_minus_7_555_in_experiment_3() {
    let header = header(512, 128, elements_1x1());
    let points = seen(&header, &[target([0.0, 30.0, 6.0], [0.0, 10.0, 0.0], 1.0)]);
    // X2: 10 − 2·8.7774; interpolation is good to 0.005 m/s (0.016 cells of 0.137 m/s).
    assert!((points.objects[0].radial_velocity_mps + 7.5548).abs() < 5e-3, "{:?}", points.objects[0]);
    assert!(!points.objects[0].velocity_resolved);
}

#[test]
fn a_moving_point_is_placed_to_2_cm_and_0_005_mps() {
    let header = header(256, 128, elements_3x4());
    for step in 0..8 {
        // Off the cells' centres by a different part each time.
        let y = 38.0 + 0.77 * f64::from(step);
        let target = target([5.75, y, 0.75], [0.0, -10.0 + 0.31 * f64::from(step), 0.0], 10.0);
        let points = seen(&header, &[target]);
        assert_eq!(points.objects.len(), 1);
        let (range, velocity, at) = truth(&header, &target);
        let object = &points.objects[0];
        assert!((object.range_m - range).abs() < 0.02, "{} against {range}", object.range_m);
        assert!(
            (object.radial_velocity_mps - velocity).abs() < 5e-3,
            "{} against {velocity}",
            object.radial_velocity_mps
        );
        for i in 0..3 {
            let error = object.position_m[i] - at[i];
            // u to 1e-4 at 40 m is 4 mm; along the road the range error counts.
            assert!(error.abs() < [5e-3, 0.02, 1e-9][i], "axis {i}: {error}");
        }
        assert_eq!(object.lane, Some(2));
    }
}
