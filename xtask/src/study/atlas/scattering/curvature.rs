//! Facets instead of a curved skin, and physical optics on small bodies.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::{documented, printed};
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::bodies;
use crate::study::closed_forms;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use artifact::settings::NodeRule;
use bart_rcs::{RcsRequest, RcsResult};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};
use wayside::host::failure::Failure;

/// Statement that `error_db` has no figure for the shape if a mesh is taken as the body itself.
fn as_given(result: &RcsResult) -> ErrorStatement {
    match result.error.tessellation {
        None => ErrorStatement::Remark("error_db.tessellation is null: facets are taken as the surface"),
        Some(_) => printed(&result.error),
    }
}

/// Flat strips of q = chord/√(ρλ): with 0.25 the complex error is −23 dB, beyond 0.7 the facets' own grating
/// lobes dominate.
pub(in crate::study::atlas) fn facets_of_a_cylinder(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("cylinder as flat strips, worst of five turns", "q");
    let (radius_m, height_m) = (0.5, 0.05);
    let exact = closed_forms::cylinder(radius_m, height_m);
    let row = |q: f64| {
        let chord_m = q * (radius_m * rcs_solvers::WAVELENGTH_M).sqrt();
        let sides = (TAU * radius_m / chord_m).round() as u32;
        let (worst, statement) = worst_turn(sides, radius_m, height_m, exact)?;
        Ok(trial.answered(q, worst, statement))
    };
    [0.1, 0.25, 0.35, 0.5, 0.71, 1.0, 2.0].into_iter().map(row).collect()
}

/// Worst error over rotations. The tube stands on z = 0; its middle is the origin of the closed form.
fn worst_turn(
    sides: u32,
    radius_m: f64,
    height_m: f64,
    exact: Complex64,
) -> Result<(f64, ErrorStatement), Failure> {
    let mut worst = (0.0_f64, ErrorStatement::Missing);
    for turn in [0.0, 0.2, 0.4, 0.6, 0.8] {
        let tube =
            bodies::shifted(bodies::tube(radius_m, height_m, sides, turn), [0.0, 0.0, -0.5 * height_m]);
        let result = rcs_solvers::trace_rcs(&tube, &rcs_solvers::first_order_request(0.0, 0.0))?;
        worst = (worst.0.max(rcs_solvers::relative_error(&result.amplitude_m, &[exact])), as_given(&result));
    }
    Ok(worst)
}

/// Small spheres against Mie's series: physical optics lacks penumbra and creeping waves.
pub(in crate::study::atlas) fn spheres_against_mie(extent: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("level of spheres against Mie's series", "ka");
    let statement = documented(
        "docs/bart.md",
        "bodies under some ten wavelengths in size (ka < 10: creeping waves, tips)",
    )?;
    let row = |radius_m: f64| {
        let cells =
            (0.5 * PI * radius_m / (0.12 * (radius_m * rcs_solvers::WAVELENGTH_M).sqrt())).ceil() as u32;
        let result = rcs_solvers::trace_rcs(
            &bodies::sphere(radius_m, cells),
            &rcs_solvers::first_order_request(10.0, 20.0),
        )?;
        let error =
            rcs_solvers::level_error(result.amplitude_m[0].norm(), closed_forms::mie_sphere(radius_m));
        Ok(trial.answered(format!("{:.2}", rcs_solvers::K * radius_m), error, statement))
    };
    let radii_m: &[f64] = match extent {
        Extent::Quick => &[0.0006, 0.0012, 0.003, 0.01],
        Extent::Full => &[0.0006, 0.0009, 0.0012, 0.002, 0.003, 0.006, 0.01, 0.03, 0.1],
    };
    radii_m.iter().copied().map(row).collect()
}

/// A cylinder on a floor, elevation 30°: 8πρh²cos(el)/λ; a node on the floor loses the divergence of the wall
/// (D3).
pub(in crate::study::atlas) fn top_hat(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("top hat, order 2 alone", "nodes");
    let (radius_m, height_m) = (0.5, 0.1);
    let elevation_deg = 30.0_f64;
    let level = (8.0 * PI * radius_m * elevation_deg.to_radians().cos() / rcs_solvers::WAVELENGTH_M).sqrt()
        * height_m;
    let hat = bodies::top_hat(radius_m, height_m, 594, 1.6);
    let row = |(name, nodes): (&str, NodeRule)| {
        let request = RcsRequest { nodes, ..rcs_solvers::request_with_bounces(5.0, elevation_deg, 2) };
        let result = rcs_solvers::trace_rcs(&hat, &request)?;
        let statement = result.model_error.nodes.map_or(ErrorStatement::Missing, ErrorStatement::Estimate);
        Ok(trial.answered(name, rcs_solvers::level_error(result.by_order_m[1][0].norm(), level), statement))
    };
    [("middle", NodeRule::Middle), ("exit", NodeRule::Exit)].into_iter().map(row).collect()
}
