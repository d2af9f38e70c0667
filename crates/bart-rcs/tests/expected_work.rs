//! Expected work of a frame before it is traced, beside what it then turns out to be: counts, which no
//! other program disturbs.
#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

mod bodies;

use artifact::scene::{Meshes, SceneFrame, SceneHeader, Target, TargetKind};
use bart_rcs::{ExpectedWork, FrameContext, Tracer};
use bodies::scenes::scene;
use bodies::{car, cuboid};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// A car and a box on wheels in the lane beside it.
fn two_bodies(car_mps: f64) -> (SceneHeader, SceneFrame) {
    let (car, truck) = (car(8).mesh(), cuboid(DVec3::new(-4.0, -1.2, 0.4), DVec3::new(4.0, 1.2, 3.2)).mesh());
    let places = [
        ([5.75, 30.0, 0.0], -FRAC_PI_2, [0.0, -car_mps, 0.0]),
        ([9.5, 33.0, 0.0], -FRAC_PI_2, [0.0, 0.0, 0.0]),
    ];
    let (mut header, frame) = scene(&car, &places);
    header.fidelity.bounces = 2;
    header.meshes = Meshes::from(vec![car, truck]);
    let kind = TargetKind::Mesh { class: None, model: "truck".into(), mesh: 1 };
    header.targets[1] = Target { id: "truck".into(), kind, ..header.targets[1].clone() };
    (header, frame)
}

fn expected((header, frame): &(SceneHeader, SceneFrame)) -> ExpectedWork {
    Tracer::new(header).unwrap().expected_work(header, frame).unwrap()
}

#[test]
fn as_many_facets_and_beams_are_expected_as_a_frame_has() {
    let scene = two_bodies(0.0);
    let expected = expected(&scene);
    let traced =
        Tracer::new(&scene.0).unwrap().paths(&scene.0, &scene.1, &FrameContext::ALONE).unwrap().trace;
    assert_eq!(expected.facets, traced.triangles as f64);
    for (order, expected) in (1..).zip(expected.beams) {
        let ratio = expected / traced.beams[order - 1] as f64;
        // 256 of each order err by 6 %, were they independent; three times the orders' together.
        assert!((ratio - 1.0).abs() < 3.0 * 0.06 * (order as f64).sqrt(), "order {order}: × {ratio}");
    }
    let paths: u64 = traced.paths.iter().sum();
    // A way and its way back are two paths of one cell.
    assert!((paths as f64) < 2.0 * expected.smaller_cells, "{paths} paths, {expected:?}");
}

#[test]
fn only_bodies_that_move_against_each_other_are_expected_to_slide() {
    let [rest, passing] = [0.0, 12.0].map(|mps| expected(&two_bodies(mps)));
    assert_eq!([rest.moving_beams, rest.moving_tiles, rest.moving_cells, rest.sliding_beams], [0.0; 4]);
    assert!(passing.moving_beams > 0.0 && passing.moving_beams < passing.beams[1], "{passing:?}");
}
