//! Error of a target's own echo beside a strong one, against the target alone.

use crate::bodies::carts::{cart, parallelogram};
use crate::frames::{anew, of_paths, pose, scene, trace};
use artifact::paths::PathsFrame;
use artifact::radar::Polarization;
use artifact::scene::{Mesh, Pose, SceneFrame, SceneHeader};
use std::f64::consts::FRAC_PI_2;

/// A plate of 0.8 m at rest that faces the radar: it is far stronger than a cart.
fn bright_plate() -> (Mesh, Pose) {
    // From 6 m up at 20 m: leaning by the elevation at which the radar stands.
    let lean = (6.0_f64 - 0.8).atan2(20.0);
    let up = [0.8 * -lean.sin(), 0.0, 0.8 * lean.cos()];
    (parallelogram([0.0, -0.4, 0.4], [0.0, 0.8, 0.0], up), pose([-6.0, 19.0, 0.0], [0.0; 3], -1.272))
}

/// Carts that pass at a speed and turn, alone or beside the plate.
fn turning_cart(beside: &[(Mesh, Pose)], accuracy_db: f64) -> (SceneHeader, SceneFrame) {
    let start = Pose { yaw_radps: 0.6, ..pose([5.75, 30.0, 0.0], [0.0, -12.0, 0.0], -FRAC_PI_2) };
    let all: Vec<(Mesh, Pose)> = [(cart(0.1), start)].into_iter().chain(beside.iter().cloned()).collect();
    scene(&all, &[], accuracy_db, 1)
}

/// Relative error of the first body's own paths against that body alone, over the band and the frame.
fn true_error(scene: &(SceneHeader, SceneFrame), frame: &PathsFrame) -> f64 {
    let frequencies: Vec<f64> = (0..9).map(|i| 76.7e9 + 0.6e9 * f64::from(i) / 8.0).collect();
    let own = PathsFrame {
        paths: frame.paths.iter().filter(|path| path.target == 0).copied().collect(),
        ..frame.clone()
    };
    let duration_s = scene.0.radar.frame_duration_s();
    let (mut error, mut power) = (0.0, 0.0);
    for seconds in [0.1, 0.3, 0.5, 0.7, 0.9].map(|share| share * duration_s) {
        let exact = anew(scene, seconds, &frequencies, Polarization::Vv);
        for (s, f) in exact.iter().zip(&frequencies) {
            error += (of_paths(scene, &own, seconds, *f)[0][0] - s).norm_sqr();
            power += s.norm_sqr();
        }
    }
    (error / power).sqrt()
}

#[test]
fn what_a_weak_target_errs_by_of_its_own_echo_is_told_beside_what_the_frame_does() {
    for accuracy_db in [-15.0, -25.0] {
        let (alone, beside) = (turning_cart(&[], accuracy_db), turning_cart(&[bright_plate()], accuracy_db));
        let [of_alone, of_beside] = [&alone, &beside].map(trace);
        let told = |frame: &PathsFrame| frame.trace.fineness.as_ref().unwrap().echo_error("body-0").unwrap();
        let whole = of_beside.error.total().unwrap();
        let errors = [true_error(&alone, &of_alone), true_error(&beside, &of_beside)];
        println!(
            "asked {accuracy_db} dB: alone told {:.4}, true {:.4}, whole {:.4}; beside a plate told {:.4}, true {:.4}, whole {whole:.4}",
            told(&of_alone),
            errors[0],
            of_alone.error.total().unwrap(),
            told(&of_beside),
            errors[1]
        );
        assert!(errors[0] <= told(&of_alone) && errors[1] <= told(&of_beside));
        assert!(told(&of_beside) < 6.0 * errors[1], "it is no bound out of reach");
        // Alone the body is the frame, except for what beams dropped.
        let frame_alone = of_alone.error.total().unwrap();
        let ratio = told(&of_alone) / frame_alone;
        assert!((0.9..=1.0 + 1e-9).contains(&ratio), "{} of {frame_alone}", told(&of_alone));
        assert!(told(&of_beside) > 3.0 * whole, "the frame's error tells of the plate");
    }
}
