//! The paths of a frame against its bodies traced and integrated anew, where they are at moments of it.

use crate::study::bodies::{self, Face};
use crate::study::rcs_solvers::{relative_error, trace_rcs};
use crate::study::scenes::{paths_of, scene_of, with_body};
use crate::study::search::differential_testing::{Outcome, Random};
use crate::study::search::random_bodies::within;
use artifact::Accuracy;
use artifact::paths::PathsFrame;
use artifact::scene::{Mesh, SceneHeader};
use artifact::settings::Edges;
use artifact::units::db_from_amplitude;
use bart_rcs::{PathView, RcsRequest, Standpoint, scattering_of_paths};
use glam::{DMat3, DVec3};
use num_complex::Complex64;
use radar::motion::pose_after;
use rand::RngExt;
use std::f64::consts::PI;
use wayside::host::failure::Failure;

/// Decibels by which the bodies that are traced anew are finer than what is asked of the frame.
const FINER_DB: f64 = 15.0;
/// Ratio by which the true error, sampled at three moments and pairs of elements, may exceed the printed one.
const BEYOND: f64 = 1.5;
/// Share of the accuracy asked by which the printed error may exceed it.
const MET: f64 = 1.001;

/// A large body of few parts, standing on the ground.
fn body(random: &mut Random) -> Mesh {
    let height_m = within(random, 0.3, 4.0);
    match random.random_range(0..6) {
        0 => bodies::tube(within(random, 0.1, 2.0), height_m, random.random_range(3..60), random.random()),
        1 => {
            let radius_m = within(random, 0.1, 1.5);
            bodies::shifted(bodies::sphere(radius_m, random.random_range(1..10)), [0.0, 0.0, radius_m])
        }
        2 => {
            let side_m = within(random, 0.3, 4.0);
            bodies::shifted(bodies::plate(side_m), [0.0, 0.0, 0.5 * side_m])
        }
        3 => {
            let angle_deg = within(random, 70.0, 110.0);
            scaled(bodies::shifted(bodies::dihedral(angle_deg), [0.0, 0.0, 0.075]), [height_m / 0.15; 3])
        }
        _ => {
            let (length_m, width_m) = (within(random, 0.5, 12.0), within(random, 0.3, 3.0));
            scaled(bodies::cube(1.0, &Face::ALL), [length_m, width_m, height_m])
        }
    }
}

fn scaled(mut body: Mesh, by: [f64; 3]) -> Mesh {
    body.vertices_m.iter_mut().for_each(|v| *v = [0, 1, 2].map(|i| by[i] * v[i]));
    body
}

/// Largest distance of a body's vertices from its origin, over the ground.
fn radius_m(body: &Mesh) -> f64 {
    body.vertices_m.iter().map(|v| v[0].hypot(v[1])).fold(0.0, f64::max)
}

/// One to three bodies apart from each other and from the radar, at rest, straight ahead or turning.
fn scene(random: &mut Random) -> Result<SceneHeader, Failure> {
    let preset = ["1x1", "3x4", "3x4", "12x16"][random.random_range(0..4)];
    let mut header = scene_of(&format!("[radar.array]\npreset = \"{preset}\"\n"))?;
    header.fidelity.bounces = random.random_range(1..=3);
    header.fidelity.accuracy = Accuracy::from_db(within(random, -30.0, -10.0));
    let mut taken: Vec<([f64; 2], f64)> = vec![];
    for _ in 0..random.random_range(1..=3) {
        let body = body(random);
        let radius_m = radius_m(&body);
        let range_m = radius_m + 10.0_f64.powf(within(random, 0.3, 1.7));
        let azimuth_rad = within(random, -0.8, 0.8);
        let at_m = [range_m * azimuth_rad.sin(), range_m * azimuth_rad.cos()];
        let apart = |(other, reach): &([f64; 2], f64)| {
            (at_m[0] - other[0]).hypot(at_m[1] - other[1]) > radius_m + reach + 0.1
        };
        if !taken.iter().all(apart) {
            continue;
        }
        taken.push((at_m, radius_m));
        header = with_body(header, &body, [at_m[0], at_m[1], 0.0], [0.0; 3]);
        let Some(target) = header.targets.last_mut() else { continue };
        target.start.yaw_rad = within(random, -PI, PI);
        if random.random_range(0..4) > 0 {
            target.start.velocity_mps = [within(random, -15.0, 15.0), within(random, -15.0, 15.0), 0.0];
        }
        if random.random_range(0..6) == 0 {
            target.start.yaw_radps = within(random, -0.6, 0.6);
        }
    }
    // Drawn last, so that the bodies of a case are those of before.
    if random.random_range(0..3) == 0 {
        header.fidelity.edges = Edges::FirstOrder;
    }
    Ok(header)
}

/// All bodies in one mesh at a moment of the frame, relative to the first one's origin.
fn joined_at(header: &SceneHeader, seconds: f64) -> (Mesh, DVec3) {
    let origin_m = DVec3::from(pose_after(&header.targets[0].start, seconds).position_m);
    let placed = |(target, mesh): (&artifact::scene::Target, &Mesh)| {
        let pose = pose_after(&target.start, seconds);
        let turn = DMat3::from_rotation_z(pose.yaw_rad);
        let mut placed = mesh.clone();
        for v in &mut placed.vertices_m {
            *v = (turn * DVec3::from(*v) + DVec3::from(pose.position_m) - origin_m).to_array();
        }
        placed
    };
    let all = header.targets.iter().zip(header.meshes.iter()).map(placed);
    (all.reduce(|a, b| bodies::joined(a, &b)).unwrap_or_default(), origin_m)
}

fn standpoint(antenna_m: DVec3) -> Standpoint {
    Standpoint {
        azimuth_rad: antenna_m.y.atan2(antenna_m.x),
        elevation_rad: (antenna_m.z / antenna_m.length()).asin(),
        range_m: antenna_m.length(),
    }
}

/// S over the band between two elements at a moment: all bodies traced anew.
fn traced_anew(
    header: &SceneHeader,
    seconds: f64,
    pair_m: [DVec3; 2],
    frequency_hz: &[f64],
) -> Result<Vec<Complex64>, Failure> {
    let (mesh, origin_m) = joined_at(header, seconds);
    let [transmitter, receiver] = pair_m.map(|antenna_m| standpoint(antenna_m - origin_m));
    let request = RcsRequest {
        range_m: transmitter.range_m,
        receiver: Some(receiver),
        polarization: header.radar.array.polarization,
        bounces: header.fidelity.bounces,
        nodes: header.fidelity.nodes,
        sides: header.fidelity.sides,
        edges: header.fidelity.edges,
        surface: header.fidelity.surface,
        accuracy: Accuracy::from_db(header.fidelity.accuracy.db() - FINER_DB),
        ..RcsRequest::over(
            frequency_hz.to_vec(),
            vec![transmitter.elevation_rad],
            vec![transmitter.azimuth_rad],
        )
    };
    Ok(trace_rcs(&mesh, &request)?.amplitude_m)
}

/// A frame of large bodies of few parts, moving before a radar on its mast: it errs by no more than it
/// prints, and that is no more than was asked.
pub(super) fn against_bodies_traced_anew(random: &mut Random) -> Result<Outcome, Failure> {
    let header = scene(random)?;
    let paths = paths_of(&header)?;
    let (mut found, mut exact) = (vec![], vec![]);
    for _ in 0..3 {
        let seconds = within(random, 0.0, header.radar.frame_duration_s());
        let frequency_hz: Vec<f64> = (0..12).map(|_| frequency_hz(&header, random)).collect();
        let array = &header.radar.array;
        let pair_m =
            [&array.tx_m, &array.rx_m].map(|all| DVec3::from(all[random.random_range(0..all.len())]));
        let (_, origin_m) = joined_at(&header, seconds);
        let centre_frequency_hz = header.radar.waveform.centre_frequency_hz();
        let [transmitter_m, receiver_m] = pair_m;
        let view = PathView { transmitter_m, receiver_m, origin_m, seconds, centre_frequency_hz };
        let (p, q) = array.polarization.indices();
        found.extend(frequency_hz.iter().map(|f| scattering_of_paths(&paths.paths, &view, *f)[p][q]));
        exact.extend(traced_anew(&header, seconds, pair_m, &frequency_hz)?);
    }
    if exact.iter().all(|s| s.norm() < 1e-6) {
        return Ok(Outcome::Uninformative);
    }
    let asked = header.fidelity.accuracy.amplitude();
    let printed = paths.error.total().unwrap_or(0.0);
    let actual = relative_error(&found, &exact);
    if actual <= BEYOND * printed.max(asked) && printed <= MET * asked {
        return Ok(Outcome::Agreed);
    }
    let [asked_db, true_db] = [asked, actual].map(db_from_amplitude);
    let (errors, bodies) = (words_of_errors(&paths), words_of_bodies(&header));
    let (channels, bounces) = (header.radar.virtual_channels(), header.fidelity.bounces);
    Ok(Outcome::Discrepancy(format!(
        "asked {asked_db:.1} dB, true {true_db:.1}, {errors}, {channels} channels, {bounces} bounces: \
         {bodies}"
    )))
}

/// The printed errors of a frame, and the fineness of its paths, in words.
fn words_of_errors(frame: &PathsFrame) -> String {
    let error = &frame.error;
    let parts = [error.total(), error.integration, error.dropped, error.freezing];
    let [total, integration, dropped, freezing] = parts.map(|part| db_from_amplitude(part.unwrap_or(0.0)));
    let fineness = frame.trace.fineness.as_ref();
    let cells = fineness.map_or_else(String::new, |fine| {
        format!(" of {:.3} m, {} moments, {} places", fine.cell_m, fine.moments, fine.places)
    });
    format!(
        "printed {total:.1} (integration {integration:.1}, dropped {dropped:.1}, freezing {freezing:.1}), {} \
         paths{cells}",
        frame.paths.len()
    )
}

fn frequency_hz(header: &SceneHeader, random: &mut Random) -> f64 {
    let waveform = &header.radar.waveform;
    waveform.start_frequency_hz + within(random, 0.0, 1.0) * waveform.bandwidth_hz()
}

/// The bodies of a scene in words.
fn words_of_bodies(header: &SceneHeader) -> String {
    let of = |(target, mesh): (&artifact::scene::Target, &Mesh)| {
        let (pose, [x, y, _]) = (&target.start, target.start.position_m);
        format!(
            "{} triangles of {:.2} m at ({x:.2}, {y:.2}) m, yaw {:.1}°, {:.1} m/s, {:.2} rad/s",
            mesh.triangles.len(),
            radius_m(mesh),
            pose.yaw_rad.to_degrees(),
            DVec3::from(pose.velocity_mps).length(),
            pose.yaw_radps
        )
    };
    header.targets.iter().zip(header.meshes.iter()).map(of).collect::<Vec<_>>().join("; ")
}
