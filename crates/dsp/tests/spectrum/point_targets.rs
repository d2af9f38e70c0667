//! Tests of what the chain says of point targets whose truth is known.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::cube::CubeHeader;
use artifact::points::PointsFrame;
use artifact::radar::Multiplexing;
use artifact::settings::{Refine, Window};
use dsp::{Receiver, power_map, range_axis_m, velocity_axis_mps};
use radar::doppler_ambiguity::folded_mps;

fn seen(header: &CubeHeader, targets: &[Target]) -> PointsFrame {
    Receiver::new(header).unwrap().process(&cube(header, targets, 1)).unwrap().1
}

/// Cell of a map's peak as (velocity, range) on the axes.
fn peak(header: &CubeHeader, targets: &[Target]) -> (f64, f64) {
    let map = Receiver::new(header).unwrap().range_doppler(&cube(header, targets, 1)).unwrap();
    let power = power_map(header, &map).unwrap();
    let (cell, _) =
        power.indexed_iter().fold(((0, 0), 0.0), |best, (at, p)| if *p > best.1 { (at, *p) } else { best });
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

/// Ranges from almost nothing to almost the fold, in every part of the first two cells and the last two.
fn at_the_ends(header: &CubeHeader) -> impl Iterator<Item = f64> {
    let (waveform, steps) = (header.radar.waveform, 1..20);
    let from_end = steps.map(move |step| f64::from(step) * 0.1 * waveform.range_resolution_m());
    from_end.flat_map(move |m| [m, waveform.range_max_m() - m])
}

#[test]
fn points_in_the_first_and_the_last_cells_are_placed_as_those_between() {
    for refine in [Refine::Off, Refine::Isolated] {
        for slope in [1.0, -1.0] {
            let mut header = header(256, 64, elements_1x1());
            header.dsp.refine = refine;
            header.radar.waveform.slope_hz_per_s *= slope;
            let (cell_m, range_max_m) =
                (header.radar.waveform.range_resolution_m(), header.radar.waveform.range_max_m());
            for range_m in at_the_ends(&header) {
                let points = seen(&header, &[target([0.0, range_m, 6.0], [0.0; 3], 1.0)]);
                let [object] = &points.objects[..] else { panic!("{range_m}: {:#?}", points.objects) };
                // Interpolation is good to a thousandth of a cell inside.
                assert!((object.range_m - range_m).abs() < 2e-3 * cell_m, "{range_m}: {object:?}");
                let mut ranges = points.points.iter().map(|point| point.range_m);
                // Hann's sidelobes, sinc(x)/(1 − x²), are over the assumed floor for seven cells; those over
                // the end stay at it.
                let is_near = |m: f64| (0.0..range_max_m).contains(&m) && (m - range_m).abs() < 7.5 * cell_m;
                assert!(ranges.all(is_near), "{range_m}: {points:?}");
                assert!(object.points > 1, "{range_m}: {object:?}");
            }
        }
    }
}

#[test]
fn range_doppler_coupling_moves_no_point_over_an_end_of_the_range_axis() {
    let header = header(256, 64, elements_1x1());
    let (cell_m, range_max_m) =
        (header.radar.waveform.range_resolution_m(), header.radar.waveform.range_max_m());
    // 62 mm at 10 m/s: the echo shows beyond the end. Its 0.04 m of way smear it over a sixth of a cell.
    for (range_m, velocity_mps) in [(0.05, -10.0), (range_max_m - 0.05, 10.0)] {
        let start_m = range_m - velocity_mps * header.radar.frame_middle_s();
        let points = seen(&header, &[target([0.0, start_m, 6.0], [0.0, velocity_mps, 0.0], 1.0)]);
        let [object] = &points.objects[..] else { panic!("{range_m}: {:#?}", points.objects) };
        assert!((object.range_m - range_m).abs() < 0.05 * cell_m, "{range_m}: {object:?}");
        assert!((object.radial_velocity_mps - velocity_mps).abs() < 0.05, "{object:?}");
    }
}

#[test]
fn a_point_a_little_beyond_the_fold_shows_as_far_behind_zero() {
    let header = header(256, 64, elements_1x1());
    let (cell_m, range_max_m) =
        (header.radar.waveform.range_resolution_m(), header.radar.waveform.range_max_m());
    for beyond_m in [0.02, 0.3, 8.6] {
        let points = seen(&header, &[target([0.0, range_max_m + beyond_m, 6.0], [0.0; 3], 1.0)]);
        assert!((points.objects[0].range_m - beyond_m).abs() < 2e-3 * cell_m, "{:?}", points.objects);
    }
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

const WINDOWS: [Window; 5] =
    [Window::Rect, Window::Hann, Window::Hamming, Window::Blackman, Window::Chebyshev(80.0)];

#[test]
fn interpolated_peaks_lie_within_2_percent_of_a_cell_for_every_window() {
    for window in WINDOWS {
        let mut header = header(256, 128, elements_1x4());
        header.dsp.range_window = window;
        header.dsp.doppler_window = window;
        let cells = [header.radar.waveform.range_resolution_m(), header.radar.velocity_resolution_mps()];
        let mut worst = [0.0_f64; 2];
        for step in 0..21 {
            // On the line along the boresight, in the frame's middle: off the cells' centres by −½ to ½, in
            // either axis.
            let (part, other) = (f64::from(step) / 20.0 - 0.5, f64::from(7 * step % 21) / 20.0 - 0.5);
            let velocity = (-12.0 + other) * cells[1];
            let range = (150.0 + part) * cells[0] - velocity * header.radar.frame_middle_s();
            let target = target([0.0, range, 6.0], [0.0, velocity, 0.0], 1.0);
            let point = seen(&header, &[target]).points[0];
            let (range_m, velocity_mps, _) = truth(&header, &target);
            worst[0] = worst[0].max((point.range_m - range_m).abs() / cells[0]);
            worst[1] = worst[1].max((point.radial_velocity_mps - velocity_mps).abs() / cells[1]);
        }
        println!("{window:?}: asked 0.02 cells, got {:.4} in range, {:.4} in velocity", worst[0], worst[1]);
        assert!(worst[0] < 0.02 && worst[1] < 0.02, "{window:?}: {worst:?}");
    }
}

/// Rows next to the end of the Doppler axis, where codes are separated by another turn on the other side, and
/// rows of staggered chirps are not the same frequency.
#[test]
fn velocities_at_the_end_of_the_doppler_axis_are_those_between() {
    for (multiplexing, stagger_s) in [(Multiplexing::Bpm, 0.0), (Multiplexing::Simultaneous, 4.5e-6)] {
        let mut header = header(64, 64, elements_3x4());
        header.radar.array.multiplexing = multiplexing;
        if stagger_s > 0.0 {
            header.radar.schedule.stagger_s = vec![0.0, stagger_s];
        }
        let (cell_mps, span_mps) =
            (header.radar.velocity_resolution_mps(), 2.0 * header.radar.velocity_max_mps());
        for step in -8..=8 {
            let velocity_mps = -0.5 * span_mps + 0.2 * f64::from(step) * cell_mps;
            let range_m = 30.3 - velocity_mps * header.radar.frame_middle_s();
            let target = target([0.0, range_m, 6.0], [0.0, velocity_mps, 0.0], 1.0);
            let point = seen(&header, &[target]).points[0];
            let error =
                folded_mps(point.radial_velocity_mps - truth(&header, &target).1, span_mps) / cell_mps;
            println!("{multiplexing:?}: {:.1} cells from the end: {error:.4}", 0.2 * f64::from(step));
            // The sidelobes of a staggered echo's images reach its own rows.
            assert!(error.abs() < 0.03, "{multiplexing:?}, step {step}: {error} cells");
        }
    }
}

#[test]
fn angles_lie_within_2_percent_of_a_beam_on_every_array() {
    let sparse = [vec![[0.0, 0.0]], [0, 1, 4, 9, 11].map(|p| [f64::from(p), 0.0]).to_vec()];
    let arrays = [
        ("1x4", elements_1x4(), 4.0),
        ("3x4", elements_3x4(), 12.0),
        ("6x8", elements_6x8(), 12.0),
        ("12x16", elements_12x16(), 192.0),
        ("sparse", sparse, 12.0),
    ];
    for (name, elements, places) in arrays {
        let places: f64 = places;
        let mut header = header(64, 16, elements);
        header.dsp.training_cells = [3, 6];
        // Cell of the angle spectrum: λ over the row's length, 2/places of u.
        let cell = 2.0 / places;
        let mut worst = 0.0_f64;
        for step in 0..21 {
            let u = (0.3 * places / 2.0).floor() * cell + (f64::from(step) / 20.0 - 0.5) * cell;
            let range_m = 30.0;
            let target = target([range_m * u, range_m * (1.0 - u * u).sqrt(), 6.0], [0.0; 3], 1.0);
            let point = seen(&header, &[target]).points[0];
            // Straight ahead in elevation: along the row the direction cosine is x/R whatever the height.
            let got = point.position_m[0] / point.range_m;
            worst = worst.max((got - target.position_m[0] / truth(&header, &target).0).abs() / cell);
        }
        println!("{name}: asked 0.02 of a beam, got {worst:.5}");
        assert!(worst < 0.02, "{name}: {worst}");
    }
}
