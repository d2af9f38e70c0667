//! Practical meshes: facets that cover, touch, duplicate or hide each other.

use crate::study::atlas::CaseRow;
use crate::study::atlas::methods;
use crate::study::atlas::verdict::Trial;
use crate::study::bodies::{self, Face};
use crate::study::closed_forms;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use artifact::scene::Mesh;
use bart_rcs::RcsRequest;
use num_complex::Complex64;
use wayside::host::failure::Failure;

/// A row in which two meshes must give equal answers, the second with its phase rotated by `turn`.
fn alike(
    trial: Trial,
    value: &str,
    meshes: [&Mesh; 2],
    request: &RcsRequest,
    turn: Complex64,
) -> Result<CaseRow, Failure> {
    let found = rcs_solvers::trace_rcs(meshes[0], request)?;
    let expected: Vec<Complex64> =
        rcs_solvers::trace_rcs(meshes[1], request)?.amplitude_m.iter().map(|s| s * turn).collect();
    Ok(trial.answered(
        value,
        rcs_solvers::relative_error(&found.amplitude_m, &expected),
        crate::study::atlas::verdict::printed(&found.error),
    ))
}

/// Coincident facets, only one of which is lit.
pub(in crate::study::atlas) fn doubled(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("every triangle there twice", "body");
    let hat = bodies::top_hat(0.05, 0.02, 60, 0.3);
    let twice = bodies::joined(hat.clone(), &hat);
    Ok(vec![alike(
        trial,
        "top hat, three bounces",
        [&twice, &hat],
        &rcs_solvers::request_with_bounces(5.0, 30.0, 3),
        Complex64::ONE,
    )?])
}

/// Lengths are stored relative to the body.
pub(in crate::study::atlas) fn far_from_the_origin(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("mesh a kilometre from its origin", "body");
    let hat = bodies::top_hat(0.05, 0.02, 60, 0.3);
    let away = bodies::shifted(hat.clone(), [1000.0, 0.0, 0.0]);
    let (azimuth_deg, elevation_deg) = (5.0_f64, 30.0_f64);
    let nearer_m = 1000.0 * elevation_deg.to_radians().cos() * azimuth_deg.to_radians().cos();
    let turn = Complex64::cis(2.0 * rcs_solvers::K * nearer_m);
    Ok(vec![alike(
        trial,
        "top hat, three bounces",
        [&away, &hat],
        &rcs_solvers::request_with_bounces(azimuth_deg, elevation_deg, 3),
        turn,
    )?])
}

/// Strips of a micrometre beside whole ones, and edges that meet no vertex.
pub(in crate::study::atlas) fn needles(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("plate of needles and T-junctions", "mesh");
    let needles = bodies::plate_in_strips(0.3, &[0.0, 0.3, 0.300_001, 0.300_002, 0.6, 0.600_000_01, 1.0]);
    let row = |(name, body): (&str, Mesh)| {
        let found = rcs_solvers::trace_rcs(&body, &rcs_solvers::first_order_request(3.0, 0.0))?;
        let exact = closed_forms::plate_far(0.3, 3_f64.to_radians());
        Ok(trial.answered(
            name,
            rcs_solvers::relative_error(&found.amplitude_m, &[exact]),
            crate::study::atlas::verdict::printed(&found.error),
        ))
    };
    [("slivers of 0.3 µm and 3 nm", needles), ("T-junctions", with_t_junctions())]
        .into_iter()
        .map(row)
        .collect()
}

/// The left half of a plate as two triangles, the right half as six strips.
fn with_t_junctions() -> Mesh {
    let (side_m, half_m) = (0.3, 0.15);
    let left = bodies::parallelograms(&[[[0.0, -half_m, -half_m], [0.0, half_m, 0.0], [0.0, 0.0, side_m]]]);
    let strip = |i: u32| {
        let low_m = side_m * f64::from(i) / 6.0 - half_m;
        [[0.0, 0.0, low_m], [0.0, half_m, 0.0], [0.0, 0.0, side_m / 6.0]]
    };
    bodies::joined(left, &bodies::parallelograms(&(0..6).map(strip).collect::<Vec<_>>()))
}

/// A cube with its bottom in the floor: it must neither be lit nor hide the rest of the floor.
pub(in crate::study::atlas) fn touching(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("cube on a floor, its bottom in the floor's plane", "azimuth_deg");
    let floor = bodies::floor(0.3);
    let whole = bodies::joined(bodies::cube(0.1, &Face::ALL), &floor);
    let open = bodies::joined(bodies::cube(0.1, &Face::ALL[..5]), &floor);
    let row = |azimuth_deg: f64| {
        let request = rcs_solvers::request_with_bounces(azimuth_deg, 30.0, 3);
        alike(trial, &azimuth_deg.to_string(), [&whole, &open], &request, Complex64::ONE)
    };
    [0.0, 20.0].into_iter().map(row).collect()
}

/// Every tenth facet with reversed winding; facets scatter from either side.
pub(in crate::study::atlas) fn flipped(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("a tenth of the facets wound wrongly, open rim", "sides");
    let tube = bodies::joined(
        bodies::tube(0.1, 0.1, 120, 0.0),
        &bodies::shifted(bodies::plate(0.2), [-0.3, 0.0, 0.0]),
    );
    let mut wrong = tube.clone();
    wrong.triangles.iter_mut().step_by(10).for_each(|t| t.swap(1, 2));
    Ok(vec![alike(
        trial,
        "two",
        [&wrong, &tube],
        &rcs_solvers::request_with_bounces(5.0, 20.0, 3),
        Complex64::ONE,
    )?])
}
