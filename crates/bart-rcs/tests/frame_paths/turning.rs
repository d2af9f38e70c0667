//! Bodies that turn within a frame: every part has its own Doppler, and mirrors turn what they show.

use crate::bodies::carts::{cart, joined, parallelogram};
use crate::frames::{EXACT_DB, anew, check_double_bounces, of_paths, pose, scene, trace};
use crate::true_error;
use artifact::Accuracy;
use artifact::paths::PathsFrame;
use artifact::radar::Polarization;
use artifact::scene::{Mesh, Pose};
use radar::motion::pose_after;
use std::f64::consts::FRAC_PI_2;

/// A body whose x axis looks at the radar, and which turns.
fn turning(position_m: [f64; 3], velocity_mps: [f64; 3], yaw_radps: f64) -> Pose {
    Pose { yaw_radps, ..pose(position_m, velocity_mps, -FRAC_PI_2) }
}

/// Two small plates at both ends of an arm of 4 m across the line of sight.
#[test]
fn the_ends_of_an_arm_approach_and_leave_as_fast_as_it_turns() {
    let plate = |y_m: f64| parallelogram([0.0, y_m - 0.02, 5.98], [0.0, 0.04, 0.0], [0.0, 0.0, 0.04]);
    let arm = joined(&[plate(-2.0), plate(2.0)]);
    let scene = scene(&[(arm, turning([0.0, 30.0, 0.0], [0.0, -5.0, 0.0], 0.8))], &[], -40.0, 1);
    let frame = trace(&scene);
    assert!(frame.paths.len() >= 2);
    for path in &frame.paths {
        // The body's y axis is the world's x axis here: v + ω × r with r = (x, 0, 0).
        let [x_m, _, _] = path.apparent_tx_m;
        assert!((x_m.abs() - 2.0).abs() < 0.03, "{x_m}");
        let [vx_mps, vy_mps, _] = path.apparent_tx_mps;
        assert!((vy_mps - (-5.0 + 0.8 * x_m)).abs() < 1e-3, "{vy_mps} at {x_m}");
        assert!(vx_mps.abs() < 0.1);
        assert_eq!(path.apparent_tx_mps, path.apparent_rx_mps);
    }
}

/// A cart in a bend with three bounces, against itself traced anew at moments of the frame.
#[test]
fn the_paths_of_a_body_that_turns_are_its_scattering_amplitude_all_through_the_frame() {
    let start = turning([2.0, 25.0, 0.0], [3.0, -6.0, 0.0], 0.5);
    let scene = scene(&[(cart(0.1), start)], &[], -20.0, 3);
    let frame = trace(&scene);
    let duration_s = scene.0.radar.frame_duration_s();
    let centre_hz = scene.0.radar.waveform.centre_frequency_hz();
    let stiff =
        without_its_turning(&frame, pose_after(&start, 0.5 * duration_s).velocity_mps, 0.5 * duration_s);
    let (mut error, mut power, mut still) = (0.0, 0.0, 0.0);
    for moment in 0..5 {
        let seconds = 0.25 * f64::from(moment) * duration_s;
        let exact = anew(&scene, seconds, &[centre_hz], Polarization::Vv)[0];
        let off = |frame: &_| (of_paths(&scene, frame, seconds, centre_hz)[0][0] - exact).norm_sqr();
        error += off(&frame);
        still += off(&stiff);
        power += exact.norm_sqr();
    }
    let [got, without, told] =
        [error / power, still / power, frame.error.total().unwrap().powi(2)].map(|e| 10.0 * e.log10());
    println!("a cart in a bend: true {got:.1} dB, told {told:.1} dB, without its turning {without:.1} dB");
    assert!(got <= told + 1.0 && without > -10.0, "{got} {told} {without}");
}

/// Paths whose nodes are where they are at `middle_s` and all have the velocity of the body's origin there.
fn without_its_turning(frame: &PathsFrame, of_origin_mps: [f64; 3], middle_s: f64) -> PathsFrame {
    let mut stiff = frame.clone();
    let stiffen = |at_m: &mut [f64; 3], mps: &mut [f64; 3]| {
        *at_m = [0, 1, 2].map(|axis| at_m[axis] + middle_s * (mps[axis] - of_origin_mps[axis]));
        *mps = of_origin_mps;
    };
    for path in &mut stiff.paths {
        stiffen(&mut path.apparent_tx_m, &mut path.apparent_tx_mps);
        stiffen(&mut path.apparent_rx_m, &mut path.apparent_rx_mps);
    }
    stiff
}

/// One wall of a dihedral turns, the other drives past: what the first shows of the second turns twice as
/// fast.
#[test]
fn a_mirror_that_turns_moves_what_it_shows() {
    let wall = |side: f64| parallelogram([0.0, 0.0, -0.2], [-0.4, side * 0.4, 0.0], [0.0, 0.0, 0.4]);
    let start = pose([2.0, 20.0, 6.0], [0.0, -10.0, 0.0], FRAC_PI_2);
    let bent = Pose { yaw_radps: 0.6, ..start };
    let past = Pose { velocity_mps: [1.0, -9.0, 0.0], ..start };
    let scene = scene(&[(wall(1.0), bent), (wall(-1.0), past)], &[], -40.0, 2);
    check_double_bounces(&scene);
}

/// A panel of 1.5 m flashes as it turns: its lobe passes within the frame, which no path follows.
#[test]
fn what_a_panel_that_turns_loses_of_its_flash_is_told() {
    let panel: Mesh = parallelogram([0.0, -0.75, 0.5], [0.0, 1.5, 0.0], [0.0, 0.0, 1.0]);
    for yaw_radps in [0.1, 0.5, 2.0] {
        let scene =
            scene(&[(panel.clone(), turning([0.0, 25.0, 0.0], [0.0, -6.0, 0.0], yaw_radps))], &[], -20.0, 1);
        let frame = trace(&scene);
        let (told, got) = (frame.error.total().unwrap(), true_error(&scene, &frame));
        let [told_db, got_db] = [told, got].map(|e| 20.0 * e.log10());
        println!("{yaw_radps} rad/s: {} paths, told {told_db:.1}, true {got_db:.1} dB", frame.paths.len());
        let referee = Accuracy::from_db(EXACT_DB).amplitude();
        assert!(got <= told + referee, "{yaw_radps} rad/s: told {told_db}, true {got_db}");
    }
}

/// Carts in bends: what is told of their paths covers what they err by, in all but one.
#[test]
fn the_error_told_of_bodies_in_bends_covers_the_true_one() {
    const CASES: u64 = 12;
    let mut beyond_db = vec![];
    for case in 0..CASES {
        let mut number = 7.0 * case as f64;
        let mut within = |low: f64, high: f64| {
            // Multiples of the golden ratio fill an interval evenly.
            number += 1.0;
            low + (high - low) * (0.618_033_988_749_894_9 * number).fract()
        };
        let (x_m, y_m, yaw_rad) = (within(-6.0, 6.0), within(10.0, 50.0), within(-3.0, 3.0));
        let (vx_mps, vy_mps, yaw_radps) = (within(-6.0, 6.0), within(-6.0, 6.0), within(-1.0, 1.0));
        let asked_db = within(-25.0, -10.0);
        let bounces = 1 + (case % 3) as u8;
        let start = Pose { yaw_radps, ..pose([x_m, y_m, 0.0], [vx_mps, vy_mps, 0.0], yaw_rad) };
        let scene = scene(&[(cart(0.05), start)], &[], asked_db, bounces);
        let frame = trace(&scene);
        let [told, got] =
            [frame.error.total().unwrap(), true_error(&scene, &frame)].map(|e| 20.0 * e.log10());
        println!(
            "{yaw_radps:.2} rad/s at {y_m:.0} m, {bounces} bounces: asked {asked_db:.1}, told {told:.1}, true {got:.1}"
        );
        beyond_db.push(got - told);
    }
    assert!(beyond_db.iter().filter(|db| **db > 0.0).count() <= 1, "{beyond_db:?}");
    assert!(beyond_db.iter().all(|db| *db < 3.0), "{beyond_db:?}");
}
