//! Antennas near, in and between bodies.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::printed;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::bodies::{self, Face};
use crate::study::closed_forms;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use artifact::scene::Mesh;
use bart_rcs::{RcsRequest, RcsResult};
use num_complex::Complex64;
use std::f64::consts::PI;
use wayside::host::failure::Failure;

fn from_near(body: &Mesh, range_m: f64, bounces: u8) -> Result<RcsResult, Failure> {
    rcs_solvers::trace_rcs(
        body,
        &RcsRequest { range_m, ..rcs_solvers::request_with_bounces(0.0, 0.0, bounces) },
    )
}

/// Antennas nearer than a wavelength, in a closed body, on a corner.
pub(in crate::study::atlas) fn antennas_in_bodies(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("antenna in a body or within a wavelength of it", "place");
    let plate = bodies::plate(0.1);
    let room = bodies::shifted(bodies::cube(2.0, &Face::ALL), [0.0, 0.0, -1.0]);
    Ok(vec![
        trial.must_refuse("on a plate", from_near(&plate, 1e-9, 1)),
        trial.must_refuse(
            "half a wavelength before a plate",
            from_near(&plate, 0.5 * rcs_solvers::WAVELENGTH_M, 1),
        ),
        trial.must_refuse("in the middle of a closed room", from_near(&room, 1e-3, 3)),
        trial.must_refuse("in a closed room, near its wall", from_near(&room, 0.99, 3)),
        trial.must_refuse("in the corner of a closed room", {
            let shifted = bodies::shifted(room.clone(), [-0.9, -0.98, -0.98]);
            from_near(&shifted, 0.08, 3)
        }),
    ])
}

/// Plates as large as, and twice as large as, their distance: the integral of interface.md.
pub(in crate::study::atlas) fn larger_than_its_distance(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("plate larger than its distance", "side_m, range_m");
    let row = |(side_m, range_m): (f64, f64)| {
        let result = from_near(&bodies::plate(side_m), range_m, 1)?;
        let exact = closed_forms::plate_near(side_m, range_m, 0.0);
        let error = rcs_solvers::relative_error(&result.amplitude_m, &[exact]);
        Ok(trial.answered(format!("{side_m}, {range_m}"), error, printed(&result.error)))
    };
    [(0.02, 0.004), (0.05, 0.05), (0.1, 0.05), (0.2, 0.05)].into_iter().map(row).collect()
}

/// A sphere from close by: geometrical optics, σ = πρ²(R/(R − ρ))² with R to its centre (P5).
pub(in crate::study::atlas) fn sphere_from_close_by(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial =
        methods::BART.trial("sphere of 10 cm from close by, geometrical optics", "distance of its skin, m");
    let radius_m = 0.1;
    let cells = (0.5 * PI * radius_m / (0.1 * (radius_m * rcs_solvers::WAVELENGTH_M).sqrt())).ceil() as u32;
    let body = bodies::sphere(radius_m, cells);
    let row = |distance_m: f64| {
        let range_m = radius_m + distance_m;
        let result = from_near(&body, range_m, 1)?;
        let level = PI.sqrt() * radius_m * range_m / distance_m;
        Ok(trial.answered(
            distance_m,
            rcs_solvers::level_error(result.amplitude_m[0].norm(), level),
            printed(&result.error),
        ))
    };
    [0.02, 0.1, 1.0].into_iter().map(row).collect()
}

const WALL_M: f64 = 0.2;
const TO_WALL_M: f64 = 1.0;
const RANGE_M: f64 = 5.0;

/// Two facing walls with the antenna midway: all orders return, without end.
pub(in crate::study::atlas) fn between_walls(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("antenna between two walls, orders without end", "bounces");
    let wall = |x_m: f64| bodies::shifted(bodies::plate(WALL_M), [x_m, 0.0, 0.0]);
    let body = bodies::joined(wall(RANGE_M - TO_WALL_M), &wall(RANGE_M + TO_WALL_M));
    let all: Complex64 = (1..=200).map(order_between_walls).sum();
    let row = |bounces: u8| {
        let result = from_near(&body, RANGE_M, bounces)?;
        let statement = match result.model_error.bounces {
            Some(left_out) => ErrorStatement::Estimate(left_out),
            None => {
                ErrorStatement::Remark("model_error_db.bounces is null: one order tells nothing of the next")
            }
        };
        Ok(trial.answered(bounces, rcs_solvers::relative_error(&result.amplitude_m, &[all]), statement))
    };
    (1..=5).map(row).collect()
}

/// Each order by its images: after K mirrors the antenna is K wall distances away, and the sequence may begin
/// at either wall.
fn order_between_walls(order: u32) -> Complex64 {
    let away = |images: u32| TO_WALL_M * f64::from(images);
    let (first, last) = if order.is_multiple_of(2) { (order + 1, order - 1) } else { (order, order) };
    let [to, back] = [away(first), away(last)];
    let places = closed_forms::nodes(WALL_M, rcs_solvers::K * WALL_M * (1.0 / to + 1.0 / back));
    let mut sum = Complex64::ZERO;
    for (y, wy) in &places {
        for (z, wz) in &places {
            let [l1, l2] = [to, back].map(|x| (x * x + y * y + z * z).sqrt());
            let cosine = 0.5 * (to / l1 + back / l2);
            let weight = wy * wz * cosine * RANGE_M * RANGE_M / (l1 * l2);
            sum += weight * Complex64::cis(-rcs_solvers::K * (l1 + l2 - 2.0 * RANGE_M));
        }
    }
    let sign = if order.is_multiple_of(2) { -2.0 } else { 2.0 };
    closed_forms::front() * sign * sum
}
