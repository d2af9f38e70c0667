//! Addition of a body to a frame's error, which decides how finely it is integrated, not what it could
//! scatter at most.

mod bodies;

use artifact::Accuracy;
use artifact::scene::{Meshes, Target, TargetKind};
use bart_rcs::{FrameContext, Tracer};
use bodies::scenes::scene;
use bodies::{car, cuboid};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// 30 m of kerb could send back 70 dBsm and sends −40 where it is seen along; the car beside it has to be
/// known finer than what is tried first.
#[test]
fn a_kerb_beside_a_car_is_integrated_coarser_than_the_car() {
    let (car, kerb) =
        (car(8).mesh(), cuboid(DVec3::new(-0.075, -15.0, 0.0), DVec3::new(0.075, 15.0, 0.12)).mesh());
    let places = [([5.75, 40.0, 0.0], -FRAC_PI_2, [0.0, -10.0, 0.0]), ([11.5, 37.5, 0.0], 0.0, [0.0; 3])];
    let (mut header, frame) = scene(&car, &places);
    header.fidelity.bounces = 1;
    header.fidelity.accuracy = Accuracy::from_db(-20.0);
    header.meshes = Meshes::from(vec![car, kerb]);
    let kind = TargetKind::Mesh { class: None, model: "kerb".into(), mesh: 1 };
    header.targets[1] = Target { kind, ..header.targets[1].clone() };
    let traced = Tracer::new(&header).unwrap().paths(&header, &frame, &FrameContext::ALONE).unwrap();
    let fineness = traced.trace.fineness.unwrap().integrals;
    println!("{fineness:?}; told {:.1} dB", 20.0 * traced.error.total().unwrap().log10());
    let [of_car, of_kerb] = [0, 1].map(|body| fineness[body].accuracy);
    assert!(of_kerb > of_car, "the car alone makes the frame finer");
}
