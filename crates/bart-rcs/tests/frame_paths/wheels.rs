//! Wheels that turn within a frame: against the closed form of a point on a rolling wheel, and against the
//! vehicle traced anew with its wheels turned by hand.

use crate::RADAR_M;
use crate::bodies::carts::{joined, parallelogram};
use crate::frames::{exact, of_paths, pose, scene, trace};
use artifact::paths::PathsFrame;
use artifact::radar::Polarization;
use artifact::scene::{Mesh, Pose, RoadWheel, SceneFrame, SceneHeader};
use artifact::settings::Wheels;
use bart_rcs::{FrameContext, Tracer};
use glam::{DMat3, DVec3};
use radar::motion::pose_after;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const RADIUS_M: f64 = 0.3;
const HUB_M: DVec3 = DVec3::new(0.4, 0.9, 0.3);

/// A wheel of flat spokes that stand out of its plane, at a hub.
fn spokes(hub_m: DVec3, count: usize) -> Mesh {
    let spoke = |k: usize| {
        let turned = |v: DVec3| DMat3::from_rotation_y(TAU * k as f64 / count as f64) * v;
        let corner = hub_m + turned(DVec3::new(-0.02, -0.02, 0.08));
        // From the hub outwards, and slanting across.
        parallelogram(
            corner.to_array(),
            turned(DVec3::new(0.0, 0.0, RADIUS_M - 0.09)).to_array(),
            turned(DVec3::new(0.04, 0.015, 0.0)).to_array(),
        )
    };
    joined(&(0..count).map(spoke).collect::<Vec<_>>())
}

/// A panel of a vehicle that leans as far as the mast looks down, with a wheel before it.
fn car() -> Mesh {
    let panel = parallelogram([0.3, 0.7, 0.2], [0.3, 0.0, 0.0], [0.0, -0.1, 0.2]);
    let first = panel.triangles.len() as u32;
    let mut mesh = joined(&[panel, spokes(HUB_M, 5)]);
    let triangles = (first..mesh.triangles.len() as u32).collect();
    mesh.wheels = vec![RoadWheel { hub_m: HUB_M.to_array(), radius_m: RADIUS_M, triangles }];
    mesh
}

fn turning(mut scene: (SceneHeader, SceneFrame)) -> (SceneHeader, SceneFrame) {
    scene.0.fidelity.wheels = Wheels::Turning;
    scene
}

/// Angle by which wheels have turned `seconds` after a pose, about y: as far as they rolled from the world's
/// origin.
fn rolled_rad(start: &Pose, seconds: f64) -> f64 {
    let ahead = |pose: &Pose| DVec3::new(pose.yaw_rad.cos(), pose.yaw_rad.sin(), 0.0);
    let hub = |pose: &Pose| DVec3::from_array(pose.position_m) + DMat3::from_rotation_z(pose.yaw_rad) * HUB_M;
    let later = pose_after(start, seconds);
    (hub(start).dot(ahead(start)) + (hub(&later) - hub(start)).dot(ahead(&later))) / RADIUS_M
}

/// The scene with the wheel of its vehicle turned by hand and rigid.
fn turned(scene: &(SceneHeader, SceneFrame), seconds: f64) -> (SceneHeader, SceneFrame) {
    let (mut header, frame) = scene.clone();
    let turn = DMat3::from_rotation_y(rolled_rad(&frame.poses[0], seconds));
    let mut mesh = header.meshes[0].clone();
    let wheel = mesh.wheels.remove(0);
    let hub_m = DVec3::from_array(wheel.hub_m);
    let corners: std::collections::BTreeSet<u32> =
        wheel.triangles.iter().flat_map(|i| mesh.triangles[*i as usize]).collect();
    for corner in corners {
        let vertex = &mut mesh.vertices_m[corner as usize];
        *vertex = (hub_m + turn * (DVec3::from_array(*vertex) - hub_m)).to_array();
    }
    header.meshes = vec![mesh].into();
    (header, frame)
}

/// Error of a frame's paths over the band at seven times of the frame, as a share of what scatters.
fn true_error(scene: &(SceneHeader, SceneFrame), frame: &PathsFrame) -> f64 {
    let duration_s = scene.0.radar.frame_duration_s();
    let frequencies: Vec<f64> = (0..6).map(|i| 77e9 + 0.625e9 * (f64::from(i) + 0.37) / 6.0).collect();
    let (mut error, mut power) = (0.0, 0.0);
    for moment in 0..7 {
        let seconds = duration_s * (f64::from(moment) + 0.5) / 7.0;
        let anew = exact(&turned(scene, seconds), seconds, [RADAR_M; 2], &frequencies, Polarization::Vv);
        for (s, f) in anew.iter().zip(&frequencies) {
            error += (of_paths(scene, frame, seconds, *f)[0][0] - s).norm_sqr();
            power += s.norm_sqr();
        }
    }
    (error / power).sqrt()
}

#[test]
fn a_plate_on_a_rolling_wheel_goes_as_the_cycloid_does() {
    // A plate of 4 mm at the rim, its wheel alone.
    let (v_mps, r_m) = (8.0, RADIUS_M);
    for angle_rad in [0.0_f64, 0.7, 2.1, 4.0] {
        let (sin, cos) = angle_rad.sin_cos();
        let corner = HUB_M + DVec3::new(r_m * cos - 0.002, 0.0, r_m * sin - 0.002);
        let mut plate = parallelogram(corner.to_array(), [0.004, 0.0, 0.0], [0.0, 0.0, 0.004]);
        plate.wheels = vec![RoadWheel { hub_m: HUB_M.to_array(), radius_m: r_m, triangles: vec![0, 1] }];
        // It drives along x past the radar, which looks along y.
        let start = pose([-1.0, 20.0, 0.0], [v_mps, 0.0, 0.0], 0.0);
        let scene = turning(scene(&[(plate, start)], &[], -40.0, 1));
        let frame = trace(&scene);
        assert!(!frame.paths.is_empty());
        for path in &frame.paths {
            let seconds = path.curve.span.map_or(scene.0.radar.frame_middle_s(), |span| {
                span.first_s + f64::from(span.moment) * span.step_s
            });
            let place = |t: f64| {
                // x = x₀ + vt, z = r; the rim turns from up to forward.
                let hub_m = DVec3::from_array(start.position_m) + HUB_M + DVec3::new(v_mps * t, 0.0, 0.0);
                let phi = angle_rad - rolled_rad(&start, t);
                hub_m + r_m * DVec3::new(phi.cos(), 0.0, phi.sin())
            };
            let of_path = |t: f64| {
                let at = DVec3::from_array(path.apparent_tx_m);
                let mps = DVec3::from_array(path.apparent_tx_mps);
                at + t * (mps + 0.5 * t * DVec3::from_array(path.curve.apparent_tx_mps2))
            };
            assert!((of_path(seconds) - place(seconds)).length() < 2e-3);
            let step_s = 1e-4;
            let mps = (of_path(seconds + step_s) - of_path(seconds - step_s)) / (2.0 * step_s);
            let known_mps = (place(seconds + step_s) - place(seconds - step_s)) / (2.0 * step_s);
            assert!((mps - known_mps).length() < 0.01 * v_mps, "{mps} {known_mps}");
            let bend = |of: &dyn Fn(f64) -> DVec3| {
                (of(seconds + step_s) + of(seconds - step_s) - 2.0 * of(seconds)) / (step_s * step_s)
            };
            let (mps2, known_mps2) = (bend(&of_path), bend(&place));
            assert!((mps2 - known_mps2).length() < 0.02 * v_mps * v_mps / r_m, "{mps2} {known_mps2}");
        }
    }
}

#[test]
fn the_paths_of_turning_spokes_are_their_scattering_amplitude_all_through_the_frame() {
    let start = pose([-0.5, 12.0, 0.0], [-10.0, -0.3, 0.0], PI + 0.03);
    for (accuracy_db, bounces) in [(-20.0, 1), (-20.0, 2), (-30.0, 1)] {
        let scene = turning(scene(&[(car(), start)], &[], accuracy_db, bounces));
        let frame = trace(&scene);
        let mut still = scene.clone();
        still.0.fidelity.wheels = Wheels::Still;
        let [got, told, as_rigid] =
            [true_error(&scene, &frame), frame.error.total().unwrap(), true_error(&scene, &trace(&still))]
                .map(|error| 20.0 * error.log10());
        let moments = frame.trace.fineness.as_ref().unwrap().moments;
        println!(
            "{bounces} bounces, asked {accuracy_db}: told {told:.1}, true {got:.1}, rigid {as_rigid:.1} dB, \
             {} paths of {moments} moments",
            frame.paths.len()
        );
        assert!(got <= told + 1.0, "told {told}, true {got}");
        assert!(told <= accuracy_db, "{told}");
        assert!(as_rigid > -6.0, "{as_rigid}");
    }
}

#[test]
fn wheels_of_a_car_that_brakes_in_a_bend_turn_with_it() {
    let ahead = pose([2.0, 12.0, 0.0], [7.0, 6.0, 0.0], 0.7);
    let start = Pose { yaw_radps: 0.5, acceleration_mps2: [-5.0, -4.0, 0.0], ..ahead };
    let scene = turning(scene(&[(car(), start)], &[], -20.0, 1));
    let frame = trace(&scene);
    let [got, told] =
        [true_error(&scene, &frame), frame.error.total().unwrap()].map(|error| 20.0 * error.log10());
    println!("in a bend: told {told:.1}, true {got:.1} dB");
    assert!(got <= told + 1.0, "told {told}, true {got}");
}

#[test]
fn a_wheel_that_stands_is_part_of_its_car() {
    // As drawn: it has rolled by nothing.
    let start = pose([-HUB_M.x, 12.0, 0.0], [0.0; 3], 0.0);
    let rigid = scene(&[(car(), start)], &[], -30.0, 2);
    let apart = turning(rigid.clone());
    let hz = rigid.0.radar.waveform.centre_frequency_hz();
    let [a, b] = [&rigid, &apart].map(|scene| of_paths(scene, &trace(scene), 0.0, hz)[0][0]);
    let miss = (a - b).norm() / a.norm();
    println!("standing: {:.1} dB", 20.0 * miss.log10());
    assert!(miss < 0.03, "{a} {b}");
}

#[test]
fn paths_and_ranges_of_wheels_are_their_vehicles_and_triangles_keep_their_numbers() {
    let start = pose([-1.5, 12.0, 0.0], [10.0, 4.0, 0.0], FRAC_PI_2);
    let scene = turning(scene(
        &[(car(), start), (car(), pose([4.0, 25.0, 0.0], [3.0, -6.0, 0.0], 0.0))],
        &[],
        -20.0,
        2,
    ));
    let frame = trace(&scene);
    assert_eq!(frame.nearest_range_m.len(), 2);
    let mut of_wheels = 0;
    for path in &frame.paths {
        assert!(path.target < 2);
        for facet in path.sequence() {
            assert!(facet.body < 2 && facet.triangle < 12);
            of_wheels += usize::from(facet.triangle >= 2);
        }
    }
    assert!(of_wheels > 0);
}

#[test]
fn a_frame_like_a_measured_one_blends_its_wheels_as_that_did() {
    let start = pose([-1.5, 12.0, 0.0], [10.0, 4.0, 0.0], 0.3);
    let (header, frame) = turning(scene(&[(car(), start)], &[], -20.0, 1));
    let tracer = Tracer::new(&header).unwrap();
    let measured = tracer.paths(&header, &frame, &FrameContext::ALONE).unwrap();
    let context = FrameContext { like: Some(&measured), ..FrameContext::ALONE };
    let like = tracer.paths(&header, &frame, &context).unwrap();
    assert!(measured.trace.fineness.as_ref().unwrap().moments > 1);
    assert!(like.paths == measured.paths);
}
