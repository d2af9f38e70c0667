//! Intersecting bodies.

use crate::study::atlas::CaseRow;
use crate::study::atlas::methods;
use crate::study::atlas::verdict::printed;
use crate::study::bodies::{self, Face};
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use crate::study::scenes::{paths_of, scene_of, with_body};
use artifact::Accuracy;
use artifact::paths::PathsFrame;
use artifact::scene::{Mesh, SceneHeader};
use bart_rcs::RcsRequest;
use glam::DVec3;
use num_complex::Complex64;
use wayside::host::failure::Failure;

/// Place of the first body, to which the scattering refers.
const PLACE_M: [f64; 3] = [2.0, 12.0, 0.0];

pub(super) fn empty(words: &str, bounces: u8) -> Result<SceneHeader, Failure> {
    let mut header = scene_of(&format!(
        "[radar.waveform]\nstart_frequency_ghz = 76.6875\nchirps = 8\n[radar.array]\npreset = \"1x1\"\n\
         {words}"
    ))?;
    header.fidelity.accuracy = Accuracy::from_db(-40.0);
    header.fidelity.bounces = bounces;
    Ok(header)
}

/// S of a frame's paths relative to the first body, at 77 GHz.
fn summed(header: &SceneHeader, frame: &PathsFrame) -> [[Complex64; 2]; 2] {
    rcs_solvers::first_body_scattering(header, &frame.paths, rcs_solvers::FREQUENCY_HZ)
}

/// Dense sampling of all bodies as one mesh, in the axes of the first.
fn sampled(header: &SceneHeader, body: &Mesh) -> Result<Complex64, Failure> {
    let from_m = DVec3::from(header.radar.position_m) - DVec3::from(header.targets[0].start.position_m);
    // Its front faces −y: body x is −y of the world, body y is x.
    let seen_m = DVec3::new(-from_m.y, from_m.x, from_m.z);
    let request = RcsRequest {
        azimuth_rad: vec![seen_m.y.atan2(seen_m.x)],
        elevation_rad: vec![(seen_m.z / seen_m.length()).asin()],
        range_m: seen_m.length(),
        ..rcs_solvers::first_order_request(0.0, 0.0)
    };
    rcs_solvers::po_amplitude(body, &request, 2.0, 6)
}

/// Two boxes of 20 cm, the second shifted: at the place of the other, half in it, a wavelength in front of
/// it.
pub(in crate::study::atlas) fn boxes(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::PATHS
        .trial("bodies that stand in one another, dense sampling of both", "the second's place, m");
    let body = bodies::cube(0.2, &Face::ALL);
    let row = |shift_m: [f64; 3]| {
        // In the body's axes: its x is −y of the world.
        let second_m = [PLACE_M[0] + shift_m[1], PLACE_M[1] - shift_m[0], PLACE_M[2] + shift_m[2]];
        let header = with_body(empty("", 1)?, &body, PLACE_M, [0.0; 3]);
        let header = with_body(header, &body, second_m, [0.0; 3]);
        let frame = paths_of(&header)?;
        let exact = sampled(&header, &bodies::joined(body.clone(), &bodies::shifted(body.clone(), shift_m)))?;
        let says = printed(&frame.error);
        let error = rcs_solvers::relative_error(&[summed(&header, &frame)[0][0]], &[exact]);
        Ok(trial.answered(format!("{shift_m:?}"), error, says))
    };
    [[0.1, 0.07, 0.0], [0.0, 0.1, 0.05], [0.004, 0.0, 0.0], [-0.3, 0.05, 0.0]].into_iter().map(row).collect()
}

/// Two identical bodies at one place are one body.
pub(in crate::study::atlas) fn twice(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::PATHS.trial("a body that is there twice, against once", "body");
    let row = |(name, body): (&str, Mesh)| {
        let once = with_body(empty("", 3)?, &body, PLACE_M, [0.0; 3]);
        let twice = with_body(once.clone(), &body, PLACE_M, [0.0; 3]);
        let (one, two) = (paths_of(&once)?, paths_of(&twice)?);
        let says = printed(&two.error);
        let error = rcs_solvers::relative_error(&[summed(&twice, &two)[0][0]], &[summed(&once, &one)[0][0]]);
        Ok(trial.answered(name, error, says))
    };
    [("box", bodies::cube(0.2, &Face::ALL)), ("dihedral", bodies::dihedral(90.0))]
        .into_iter()
        .map(row)
        .collect()
}

/// A long wall nearer to the radar than its length: parts of it are at grazing, others at normal incidence.
pub(in crate::study::atlas) fn nearer_than_long(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::PATHS.trial("body longer than its distance, dense sampling", "length_m, distance_m");
    let row = |(length_m, distance_m): (f64, f64)| {
        let wall =
            bodies::parallelograms(&[[[0.0, -0.5 * length_m, -0.1], [0.0, length_m, 0.0], [0.0, 0.0, 0.2]]]);
        let header = with_body(empty("", 1)?, &wall, [0.3, distance_m, 6.0], [0.0; 3]);
        let frame = paths_of(&header)?;
        let exact = sampled(&header, &wall)?;
        let says = printed(&frame.error);
        let error = rcs_solvers::relative_error(&[summed(&header, &frame)[0][0]], &[exact]);
        Ok(trial.answered(format!("{length_m}, {distance_m}"), error, says))
    };
    [(1.0, 0.5), (3.0, 1.0)].into_iter().map(row).collect()
}
