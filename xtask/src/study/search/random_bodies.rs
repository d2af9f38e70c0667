//! Random bodies and aspects.

use crate::study::bodies::{self, Face};
use crate::study::rcs_solvers;
use crate::study::search::differential_testing::Random;
use artifact::Accuracy;
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use bart_rcs::RcsRequest;
use rand::RngExt;

/// A random number in an interval.
pub(super) fn within(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.random::<f64>()
}

fn vector(random: &mut Random, most: f64) -> [f64; 3] {
    [0; 3].map(|_| within(random, -most, most))
}

/// A body of a few parts that may be separate, nested or intersecting.
pub(super) fn body(random: &mut Random) -> Mesh {
    let mut all = part(random);
    for _ in 0..random.random_range(0..3) {
        let at_m = vector(random, 0.08);
        all = bodies::joined(all, &bodies::shifted(part(random), at_m));
    }
    all
}

fn part(random: &mut Random) -> Mesh {
    match random.random_range(0..7) {
        0 => soup(random),
        1 => bodies::plate(within(random, 0.01, 0.12)),
        2 => {
            let sides = random.random_range(3..90);
            bodies::tube(within(random, 0.01, 0.06), within(random, 0.01, 0.08), sides, random.random())
        }
        3 => bodies::sphere(within(random, 0.01, 0.05), random.random_range(1..12)),
        4 => box_of(random),
        5 => bodies::floor(within(random, 0.02, 0.15)),
        _ => bodies::top_hat(
            within(random, 0.01, 0.05),
            within(random, 0.005, 0.03),
            random.random_range(6..60),
            within(random, 0.03, 0.15),
        ),
    }
}

/// Intersecting parallelograms.
fn soup(random: &mut Random) -> Mesh {
    let count = random.random_range(1..6);
    let list: Vec<_> =
        (0..count).map(|_| [vector(random, 0.05), vector(random, 0.06), vector(random, 0.06)]).collect();
    bodies::parallelograms(&list)
}

/// A box with some of its faces, with unequal sides.
pub(super) fn box_of(random: &mut Random) -> Mesh {
    let mut faces: Vec<Face> = Face::ALL.into_iter().filter(|_| random.random_range(0..3) > 0).collect();
    if faces.is_empty() {
        faces.push(Face::Front);
    }
    let sides_m = [0; 3].map(|_| within(random, 0.02, 0.1));
    let mut body = bodies::cube(1.0, &faces);
    body.vertices_m.iter_mut().for_each(|v| *v = [0, 1, 2].map(|i| sides_m[i] * v[i]));
    body
}

/// A random aspect, near or infinitely far.
pub(super) fn request(random: &mut Random, bounces: u8) -> RcsRequest {
    let range_m = if random.random() { f64::INFINITY } else { within(random, 0.6, 30.0) };
    RcsRequest {
        range_m,
        polarization: polarization(random),
        accuracy: Accuracy::from_db(within(random, -60.0, -20.0)),
        ..rcs_solvers::request_with_bounces(
            within(random, -180.0, 180.0),
            within(random, -85.0, 85.0),
            bounces,
        )
    }
}

pub(super) fn polarization(random: &mut Random) -> Polarization {
    if random.random() { Polarization::Vv } else { Polarization::Hh }
}

/// A case in words.
pub(super) fn words(body: &Mesh, request: &RcsRequest) -> String {
    format!(
        "{} triangles, azimuth {:.3}°, elevation {:.3}°, range {:.3} m, {:?}, {:.1} dB asked",
        body.triangles.len(),
        request.azimuth_rad[0].to_degrees(),
        request.elevation_rad[0].to_degrees(),
        request.range_m,
        request.polarization,
        request.accuracy.db()
    )
}
