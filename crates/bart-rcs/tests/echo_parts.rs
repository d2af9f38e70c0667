//! What the parts of an echo are told to be by the coarse look, beside what frames with and without them
//! differ by.

#![allow(clippy::unwrap_used, reason = "a test ends where it meets what it did not expect")]

mod bodies;

use artifact::Accuracy;
use artifact::paths::PathsFrame;
use artifact::scene::{Meshes, SceneFrame, SceneHeader, Target, TargetKind};
use artifact::settings::{BetweenBodies, Edges, NodeRule};
use bart_rcs::{EchoParts, FrameContext, NoProgress, PathView, Tracer, scattering_of_paths, usual_road};
use bodies::scenes::scene;
use bodies::{car, cuboid};
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::FRAC_PI_2;

/// A car and a box beside and behind it.
fn two_bodies() -> (SceneHeader, SceneFrame) {
    let (car, truck) = (car(8).mesh(), cuboid(DVec3::new(-4.0, -1.2, 0.4), DVec3::new(4.0, 1.2, 3.2)).mesh());
    let places = [([5.75, 30.0, 0.0], -FRAC_PI_2, [0.0; 3]), ([9.5, 33.0, 0.0], -FRAC_PI_2, [0.0; 3])];
    let (mut header, frame) = scene(&car, &places);
    header.fidelity.bounces = 3;
    header.fidelity.accuracy = Accuracy::from_db(-30.0);
    header.meshes = Meshes::from(vec![car, truck]);
    let kind = TargetKind::Mesh { class: None, model: "truck".into(), mesh: 1 };
    header.targets[1] = Target { id: "truck".into(), kind, ..header.targets[1].clone() };
    (header, frame)
}

fn parts(header: &SceneHeader, frame: &SceneFrame) -> EchoParts {
    Tracer::new(header).unwrap().echo_parts(header, frame, &NoProgress).unwrap().unwrap()
}

fn traced(header: &SceneHeader, frame: &SceneFrame) -> PathsFrame {
    Tracer::new(header).unwrap().paths(header, frame, &FrameContext::ALONE).unwrap()
}

/// S of a frame over the band, one number for each of 32 frequencies.
fn over_band(header: &SceneHeader, frame: &PathsFrame) -> Vec<Complex64> {
    let (waveform, radar_m) = (&header.radar.waveform, DVec3::from_array(header.radar.position_m));
    let centre_hz = waveform.centre_frequency_hz();
    let view = PathView {
        transmitter_m: radar_m,
        receiver_m: radar_m,
        origin_m: radar_m + DVec3::Y,
        seconds: header.radar.frame_middle_s(),
        centre_frequency_hz: centre_hz,
    };
    let frequency = |i: i32| centre_hz + waveform.bandwidth_hz() * (f64::from(i) + 0.5 - 16.0) / 32.0;
    (0..32).map(|i| scattering_of_paths(&frame.paths, &view, frequency(i))[0][0]).collect()
}

/// Root mean square of the difference of two frames relative to the first, with and without a change.
fn difference(of: impl Fn(&mut SceneHeader)) -> f64 {
    let (header, frame) = two_bodies();
    difference_of(&header, &frame, of)
}

/// The same of a scene; both frames are finer than the shares looked at, as each has cells of its own.
fn difference_of(header: &SceneHeader, frame: &SceneFrame, of: impl Fn(&mut SceneHeader)) -> f64 {
    let mut header = header.clone();
    header.fidelity.accuracy = Accuracy::from_db(-55.0);
    let mut changed = header.clone();
    of(&mut changed);
    let [whole, less] = [&header, &changed].map(|header| over_band(header, &traced(header, frame)));
    let power = |values: &mut dyn Iterator<Item = Complex64>| values.map(|s| s.norm_sqr()).sum::<f64>();
    (power(&mut whole.iter().zip(&less).map(|(a, b)| a - b)) / power(&mut whole.iter().copied())).sqrt()
}

/// A share holds what leaving a part out does, and is no more than four times that: the look's margin is
/// 1.4, its integrals are good to a quarter, and it sees other frequencies.
fn assert_holds(told: f64, true_share: f64, name: &str) {
    let ratio = told / true_share;
    assert!((0.7..4.0).contains(&ratio), "{name}: {told} told, {true_share} true");
}

#[test]
fn shares_are_what_frames_with_and_without_a_part_differ_by() {
    let (header, frame) = two_bodies();
    let parts = parts(&header, &frame);
    let order = |order: usize| parts.within[order - 1].hypot(parts.between[order - 1]);
    assert_holds(order(3), difference(|header| header.fidelity.bounces = 2), "third order");
    let together = |shares: &[f64]| shares.iter().map(|share| share * share).sum::<f64>().sqrt();
    let between = together(&parts.between[..3]);
    let apart = difference(|header| header.fidelity.between_bodies = BetweenBodies::LeftOut);
    assert_holds(between, apart, "between bodies");
    let edges = difference(|header| header.fidelity.edges = Edges::FirstOrder);
    assert_holds(together(&parts.edges[..3]), edges, "edges");
    let road = difference(|header| header.road = usual_road());
    assert_holds(together(&parts.road.unwrap().by_order), road, "road");
}

#[test]
fn orders_are_told_by_the_node_rule_of_the_scene() {
    let third = |nodes: NodeRule| {
        let (mut header, frame) = two_bodies();
        header.fidelity.nodes = nodes;
        let parts = parts(&header, &frame);
        let left_out = |header: &mut SceneHeader| header.fidelity.bounces = 2;
        let true_share = difference_of(&header, &frame, left_out);
        let told = parts.within[2].hypot(parts.between[2]);
        println!("{nodes:?}: {told} told, {true_share} true");
        assert_holds(told, true_share, "third order");
        told
    };
    let [middle, own_edge] = [NodeRule::Middle, NodeRule::OwnEdge].map(third);
    assert!((middle / own_edge).ln().abs() > 0.02, "{middle} and {own_edge}: rules differ, and so do shares");
}

#[test]
fn a_body_alone_has_no_ways_between_bodies_and_a_plate_none_of_higher_order() {
    let plate = cuboid(DVec3::new(-0.001, -0.5, 0.5), DVec3::new(0.001, 0.5, 1.5)).mesh();
    let (header, frame) = scene(&plate, &[([0.0, 30.0, 0.0], -FRAC_PI_2, [0.0; 3])]);
    let parts = parts(&header, &frame);
    assert!(parts.between.iter().all(|share| *share == 0.0), "{parts:?}");
    assert!(parts.within[1..].iter().all(|share| *share < 1e-6), "{parts:?}");
    assert!((parts.within[0] - 1.4).abs() < 1e-9, "the whole with the margin: {parts:?}");
    assert_eq!(parts.transmission, 0.0);
}

#[test]
fn nothing_in_view_has_no_parts_and_what_the_scene_asks_for_changes_none() {
    let (header, frame) = two_bodies();
    let mut coarse = header.clone();
    coarse.fidelity.bounces = 1;
    coarse.fidelity.accuracy = Accuracy::from_db(-5.0);
    coarse.fidelity.between_bodies = BetweenBodies::LeftOut;
    assert_eq!(parts(&coarse, &frame), parts(&header, &frame));
    let mut empty = header.clone();
    empty.targets.clear();
    let nothing = SceneFrame { poses: vec![], ..frame };
    assert_eq!(Tracer::new(&empty).unwrap().echo_parts(&empty, &nothing, &NoProgress).unwrap(), None);
}
