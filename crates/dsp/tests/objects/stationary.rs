//! Echoes at rest: told apart from what moves, or left out, as the settings ask.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::cube::CubeHeader;
use artifact::points::{Object, PointsFrame};
use artifact::radar::Multiplexing;
use artifact::settings::StaticEchoes;
use dsp::Receiver;
use dsp::{FoldCertainty, is_at_rest, tolerance_mps};

/// A rail or a kerb: reflectors every 2 m beside the lanes, strong and weak, none of which moves.
fn row_of_reflectors() -> Vec<Target> {
    let place = |i: i32| [12.2, 22.0 + 2.0 * f64::from(i), 0.6];
    (0..12).map(|i| target(place(i), [0.0; 3], if i % 3 == 0 { 3.0 } else { 0.3 })).collect()
}

/// A car in lane 2, driving on.
fn car(speed_mps: f64) -> Vec<Target> {
    vehicle([5.75, 36.0], [4.5, 1.8, 1.5], -speed_mps, 4)
}

fn asked(static_echoes: StaticEchoes) -> CubeHeader {
    let mut header = header(256, 128, elements_3x4());
    header.noise = NOISE_12_DB;
    header.dsp.static_echoes = static_echoes;
    header
}

fn seen(header: &CubeHeader, targets: &[Target], seed: u64) -> PointsFrame {
    Receiver::new(header).unwrap().process(&cube(header, targets, seed)).unwrap().1
}

fn street() -> Vec<Target> {
    [row_of_reflectors(), car(8.0)].concat()
}

fn unmarked(mut frame: PointsFrame) -> PointsFrame {
    frame.points.iter_mut().for_each(|point| point.stationary = None);
    frame.objects.iter_mut().for_each(|object| object.stationary = None);
    frame
}

#[test]
fn a_row_of_reflectors_is_told_to_be_at_rest_and_a_car_beside_it_is_not() {
    for seed in 0..4 {
        let frame = seen(&asked(StaticEchoes::Mark), &street(), seed);
        let moves = |object: &&Object| object.stationary == Some(false);
        let moving: Vec<&Object> = frame.objects.iter().filter(moves).collect();
        assert_eq!(moving.len(), 1, "seed {seed}: {:#?}", frame.objects);
        assert!((moving[0].range_m - 35.0).abs() < 3.0 && moving[0].lane == Some(2), "{:#?}", moving[0]);
        assert!(frame.objects.len() > 1, "the row is seen: {:#?}", frame.objects);
        // Each point is told with the peak that it lies under: points of an object at rest are at rest, on
        // whatever row of the lobe.
        for point in &frame.points {
            let of_object = point.object.and_then(|o| frame.objects[o as usize].stationary);
            assert!(
                point.stationary.is_some() && of_object.is_none_or(|told| Some(told) == point.stationary),
                "{point:?}"
            );
        }
    }
}

#[test]
fn marking_changes_nothing_but_the_marks() {
    let keep = seen(&asked(StaticEchoes::Keep), &street(), 1);
    assert!(keep.points.iter().all(|point| point.stationary.is_none()));
    assert!(keep.objects.iter().all(|object| object.stationary.is_none()));
    assert_eq!(unmarked(seen(&asked(StaticEchoes::Mark), &street(), 1)), keep);
}

#[test]
fn removed_echoes_leave_the_car_alone_and_it_stays_as_it_was() {
    let mark = seen(&asked(StaticEchoes::Mark), &street(), 2);
    let left = seen(&asked(StaticEchoes::Remove), &street(), 2);
    assert_eq!(left.objects.len(), 1, "{:#?}", left.objects);
    let own = mark.objects.iter().find(|object| object.stationary == Some(false)).unwrap();
    assert_eq!(&left.objects[0], own);
    assert!(!left.points.is_empty() && left.points.iter().all(|point| point.stationary == Some(false)));
    let moving = mark.points.iter().filter(|point| point.stationary == Some(false)).count();
    assert_eq!(left.points.len(), moving);
}

#[test]
fn a_vehicle_that_waits_is_removed_with_the_rest() {
    let frame = seen(&asked(StaticEchoes::Remove), &car(0.0), 3);
    assert!(frame.objects.is_empty() && frame.points.len() <= 1, "noise alone may be left: {frame:#?}");
    assert!(!seen(&asked(StaticEchoes::Mark), &car(0.0), 3).objects.is_empty());
}

/// Half a cell either way, and the errors of weak echoes beside.
#[test]
fn what_is_slower_than_half_a_doppler_cell_is_at_rest_and_what_is_faster_is_not() {
    let header = asked(StaticEchoes::Mark);
    let cell_mps = header.radar.velocity_resolution_mps();
    assert!((tolerance_mps(&header.radar, 1e12) / cell_mps - 0.5).abs() < 1e-5);
    // √6/(2π)/√100 = 0.039 cells, six times.
    assert!((tolerance_mps(&header.radar, 100.0) / cell_mps - 0.7339).abs() < 1e-3);
    for (cells, rests) in [(0.0, true), (0.3, true), (-0.4, true), (1.3, false), (-2.0, false)] {
        let moving = target([5.75, 36.0, 0.75], [0.0, cells * cell_mps, 0.0], 10.0);
        let frame = seen(&header, &[moving], 5);
        assert_eq!(frame.objects.len(), 1);
        assert_eq!(frame.objects[0].stationary, Some(rests), "{cells} cells: {:#?}", frame.objects);
    }
}

#[test]
fn a_blind_speed_is_rest_unless_its_fold_is_told() {
    let mut header = asked(StaticEchoes::Mark);
    let span_mps = 2.0 * header.radar.velocity_max_mps();
    assert!(
        is_at_rest(&header.radar, span_mps, FoldCertainty::Assumed, 1e6)
            && !is_at_rest(&header.radar, span_mps, FoldCertainty::Resolved, 1e6)
    );
    // Time division tells the folds by the turns of its slots: λ/4T of three slots is 5.4 m/s.
    header.radar.array.multiplexing = Multiplexing::Tdm;
    let span_mps = 2.0 * header.radar.velocity_max_mps();
    let fast = target([0.3, 36.0, 0.75], [0.0, -span_mps * 36.0_f64.hypot(5.25) / 36.0, 0.0], 10.0);
    let frame = seen(&header, &[fast], 6);
    let [object] = &frame.objects[..] else { panic!("{frame:#?}") };
    let is_told = object.velocity_resolved && object.radial_velocity_mps.abs() > 1.0;
    assert_eq!(object.stationary, Some(!is_told), "{object:#?}");
}
