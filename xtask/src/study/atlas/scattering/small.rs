//! Bodies far smaller than a wavelength, and far larger than a vehicle.

use crate::study::atlas::CaseRow;
use crate::study::atlas::methods;
use crate::study::atlas::verdict::{documented, printed};
use crate::study::bodies;
use crate::study::closed_forms;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use artifact::scene::Mesh;
use artifact::settings::Edges;
use bart_rcs::RcsRequest;
use std::f64::consts::{PI, TAU};
use wayside::host::failure::Failure;

/// A disc facing +x, as a fan of triangles.
fn disc(radius_m: f64, sides: u32) -> Mesh {
    let rim = (0..sides).map(|i| {
        let angle = TAU * f64::from(i) / f64::from(sides);
        [0.0, radius_m * angle.cos(), radius_m * angle.sin()]
    });
    let vertices_m = std::iter::once([0.0; 3]).chain(rim).collect();
    bodies::mesh(vertices_m, (0..sides).map(|i| [0, 1 + i, 1 + (i + 1) % sides]).collect())
}

/// Normal incidence on a disc with ka ≪ 1: σ = 64k⁴a⁶/9π (Rayleigh).
pub(in crate::study::atlas) fn discs(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("level of small discs against Rayleigh's", "edges, ka");
    let page = documented(
        "docs/bart.md",
        "bodies under some ten wavelengths in size (ka < 10: creeping waves, tips)",
    )?;
    let row = |(name, edges, ka): (&str, Edges, f64)| {
        let radius_m = ka / rcs_solvers::K;
        let request = RcsRequest { edges, ..rcs_solvers::first_order_request(0.0, 0.0) };
        let result = rcs_solvers::trace_rcs(&disc(radius_m, 64), &request)?;
        let level = 8.0 / (3.0 * PI.sqrt()) * rcs_solvers::K * rcs_solvers::K * radius_m.powi(3);
        Ok(trial.answered(
            format!("{name}, {ka}"),
            rcs_solvers::level_error(result.amplitude_m[0].norm(), level),
            page,
        ))
    };
    [
        ("off", Edges::Ignored, 0.05),
        ("off", Edges::Ignored, 0.2),
        ("on", Edges::FirstOrder, 0.05),
        ("on", Edges::FirstOrder, 0.2),
    ]
    .into_iter()
    .map(row)
    .collect()
}

/// The closed form of a plate at one degree, for any size.
pub(in crate::study::atlas) fn sizes(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("plates of any size", "side_m");
    let row = |side_m: f64| {
        let result =
            rcs_solvers::trace_rcs(&bodies::plate(side_m), &rcs_solvers::first_order_request(1.0, 0.0))?;
        let exact = closed_forms::plate_far(side_m, 1_f64.to_radians());
        Ok(trial.answered(
            side_m,
            rcs_solvers::relative_error(&result.amplitude_m, &[exact]),
            printed(&result.error),
        ))
    };
    [1e-6, 1e-3, 0.1, 10.0, 500.0].into_iter().map(row).collect()
}
