//! Errors are told of what the antennas hear.

use crate::bodies::carts::{cart, parallelogram};
use crate::frames::{RADAR_M, pose, scene, trace};
use crate::true_error;
use artifact::paths::PathsFrame;
use artifact::radar::Pattern;
use artifact::scene::{Mesh, Pose, SceneFrame, SceneHeader};
use bart_rcs::{NoProgress, Tracer};
use std::f64::consts::FRAC_PI_2;

/// Azimuth of the plate off the boresight.
const ASIDE_RAD: f64 = 1.4;

/// A cart in the beam, and behind it, far aside, a plate that faces the radar.
fn bodies() -> [(Mesh, Pose); 2] {
    let plate = parallelogram([0.0, -1.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]);
    let (sin, cos) = ASIDE_RAD.sin_cos();
    let aside = [40.0 * sin, 40.0 * cos, RADAR_M[2] - 0.5];
    [
        (cart(0.1), pose([1.0, 25.0, 0.0], [0.0, -8.0, 0.0], -FRAC_PI_2)),
        (plate, pose(aside, [0.0; 3], -FRAC_PI_2 - ASIDE_RAD)),
    ]
}

/// The scene by antennas of cos⁴: the plate is heard 61 dB less than were it ahead, there and back.
fn in_a_beam(bodies: &[(Mesh, Pose)]) -> (SceneHeader, SceneFrame) {
    let mut scene = scene(bodies, &[], -20.0, 2);
    scene.0.radar.array.pattern = Pattern::Cosine { exponent: 4.0 };
    scene
}

fn told_db(frame: &PathsFrame) -> f64 {
    20.0 * frame.error.total().unwrap().log10()
}

/// Error of the cart's paths, relative to the cart's echo.
fn of_cart_db(bodies: &[(Mesh, Pose)], mut frame: PathsFrame) -> f64 {
    frame.paths.retain(|path| path.target == 0);
    20.0 * true_error(&scene(bodies, &[], -20.0, 2), &frame).log10()
}

/// The plate scatters 40 dB more than the cart. Of both as if they were heard alike less is told than the
/// cart's echo errs by, and in a beam the cart is all that is heard.
#[test]
fn the_error_told_of_a_cart_in_the_beam_covers_the_true_one_whatever_stands_beside() {
    let all = bodies();
    let (in_beam, alike) = (trace(&in_a_beam(&all)), trace(&scene(&all, &[], -20.0, 2)));
    let told = [&in_beam, &alike].map(told_db);
    let true_db = [in_beam, alike].map(|frame| of_cart_db(&all, frame));
    println!("told {told:.2?} dB, of the cart {true_db:.2?} dB: in a beam, heard alike");
    assert!(true_db[0] <= told[0] && told[0] <= -19.0, "{true_db:?} {told:?}");
    assert!(true_db[1] > told[1] + 6.0, "{true_db:?} {told:?}");
}

#[test]
fn the_far_field_error_of_tables_is_told_of_what_is_heard() {
    let [cart, plate] = bodies();
    let told = |bodies: &[(Mesh, Pose)]| {
        let scene = in_a_beam(bodies);
        let frame = Tracer::new(&scene.0).unwrap().tables(&scene.0, &scene.1, &NoProgress).unwrap();
        20.0 * frame.model_error.far_field.unwrap().log10()
    };
    let (alone, beside) = (told(std::slice::from_ref(&cart)), told(&[cart.clone(), plate]));
    println!("far field {alone:.2} dB alone, {beside:.2} dB beside the plate");
    assert!((beside - alone).abs() < 0.1, "{beside} beside {alone}");
}
