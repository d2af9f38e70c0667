//! Errors beside a point target: all of them are relative to the echo of bodies and points together.

use crate::bodies::carts::cart;
use crate::frames::{pose, scene, trace};
use artifact::scene::{SceneFrame, SceneHeader};
use artifact::settings::{NodeRule, SmallParts};
use bart_rcs::{EchoParts, NoProgress, Tracer};
use std::f64::consts::FRAC_PI_2;

/// A cart and a point of a cross section that outweighs it by more than 40 dB.
fn beside_point(rcs_m2: f64) -> (SceneHeader, SceneFrame) {
    let cart = (cart(0.1), pose([5.75, 30.0, 0.0], [0.0; 3], -FRAC_PI_2));
    let mut scene = scene(&[cart], &[(rcs_m2, pose([-4.0, 30.0, 1.0], [0.0; 3], 0.0))], -10.0, 2);
    scene.0.fidelity.nodes = NodeRule::OwnEdge;
    scene.0.fidelity.small_parts = SmallParts::Statistical;
    scene
}

/// Asserts that every error that is known and above zero halves, to the thousandth that the weak body adds to
/// the strong point's amplitude, times four for the interference of both.
fn assert_halved<const N: usize>(of: [[(&str, Option<f64>); N]; 2], least: usize) {
    let [once, fourfold] = of;
    let known =
        once.iter().zip(&fourfold).filter_map(|((name, once), (_, four))| Some((name, (*once)?, (*four)?)));
    let above_zero: Vec<_> = known.filter(|(_, once, _)| *once > 0.0).collect();
    for (name, once, four) in &above_zero {
        assert!(
            (once / four - 2.0).abs() < 0.04,
            "{name}: {once}, beside four times the cross section {four}"
        );
    }
    assert!(above_zero.len() >= least, "{above_zero:?}");
}

#[test]
fn every_error_of_paths_halves_beside_a_point_of_four_times_the_cross_section() {
    let frames = [1e6, 4e6].map(|rcs_m2| trace(&beside_point(rcs_m2)));
    let told = frames.each_ref().map(|frame| frame.model_error.sources());
    for name in ["bounces", "nodes", "road", "small_parts"] {
        assert!(told[0].iter().any(|(told, error)| *told == name && error.is_some()), "{name}: {told:?}");
    }
    assert_halved(told, 3);
    assert_halved(frames.map(|frame| [("integration", frame.error.integration)]), 1);
}

#[test]
fn every_error_of_tables_halves_beside_a_point_of_four_times_the_cross_section() {
    let frames = [1e6, 4e6].map(|rcs_m2| {
        let (mut header, frame) = beside_point(rcs_m2);
        header.fidelity.small_parts = SmallParts::OfMesh;
        Tracer::new(&header).unwrap().tables(&header, &frame, &NoProgress).unwrap()
    });
    assert_halved(frames.map(|frame| frame.model_error.sources()), 2);
}

#[test]
fn every_part_of_the_echo_halves_beside_a_point_of_four_times_the_cross_section() {
    let [once, fourfold] = [1e6, 4e6].map(|rcs_m2| {
        let (header, frame) = beside_point(rcs_m2);
        Tracer::new(&header).unwrap().echo_parts(&header, &frame, &NoProgress).unwrap().unwrap()
    });
    let parts = |of: &EchoParts| {
        let by_road = of.road.as_ref().map_or(0.0, |road| road.by_order[0]);
        [
            ("first order", Some(of.within[0])),
            ("second order", Some(of.within[1])),
            ("nodes", Some(of.nodes)),
            ("road", Some(by_road)),
            ("edges", Some(of.edges[0])),
        ]
    };
    assert_halved([parts(&once), parts(&fourfold)], 5);
    let power = |of: &EchoParts| of.amplitude_m.iter().map(|s| s.norm_sqr()).sum::<f64>();
    assert!((power(&fourfold) / power(&once) - 4.0).abs() < 0.1, "the whole has the point");
    assert!((fourfold.road.unwrap().whole - 1.0).abs() < 0.02, "and the road adds little to it");
}
