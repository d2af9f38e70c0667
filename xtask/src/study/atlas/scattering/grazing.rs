//! Surfaces near grazing incidence.

use crate::study::atlas::methods::{self, Method};
use crate::study::atlas::verdict::{documented, printed, without_edges};
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::bodies;
use crate::study::closed_forms;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use artifact::settings::{Edges, Sides};
use bart_rcs::RcsRequest;
use po_sbr::{Bracket, sbr};
use std::f64::consts::PI;
use wayside::host::failure::Failure;

/// The closed form of physical optics goes to zero along the plate.
pub(in crate::study::atlas) fn plate(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("plate seen nearly along itself", "degrees from its plane");
    let body = bodies::plate(0.1);
    let row = |grazing_deg: f64| {
        let result =
            rcs_solvers::trace_rcs(&body, &rcs_solvers::first_order_request(90.0 - grazing_deg, 0.0))?;
        let exact = closed_forms::plate_far(0.1, (90.0 - grazing_deg).to_radians());
        Ok(trial.answered(
            grazing_deg,
            rcs_solvers::relative_error(&result.amplitude_m, &[exact]),
            printed(&result.error),
        ))
    };
    [10.0, 1.0, 0.1, 1e-3, 1e-6].into_iter().map(row).collect()
}

/// A wall of a corner at 5° and less to the line of sight, so that beams run along it: 16π(ab)²sin²(45° −
/// φ)/λ² (D1).
pub(in crate::study::atlas) fn wall_of_a_corner(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("beams almost along a wall of a corner", "degrees from the wall");
    let body = bodies::dihedral(90.0);
    let row = |grazing_deg: f64| {
        let result =
            rcs_solvers::trace_rcs(&body, &rcs_solvers::request_with_bounces(45.0 - grazing_deg, 0.0, 2))?;
        let level = (16.0 * PI).sqrt() * 0.15_f64.powi(2) / rcs_solvers::WAVELENGTH_M
            * grazing_deg.to_radians().sin();
        // Relative to the whole of S, like the printed error.
        let error = (result.by_order_m[1][0].norm() - level).abs() / result.amplitude_m[0].norm();
        Ok(trial.answered(grazing_deg, error, printed(&result.error)))
    };
    [5.0, 1.0, 0.1, 1e-3, 1e-6].into_iter().map(row).collect()
}

/// Exact backscatter coefficients of a strip of ten wavelengths, 20·log₁₀|D| (docs/physics.md E2): degrees
/// from its plane, E along the edges, H along them.
const STRIP_DB: [(f64, f64, f64); 8] = [
    (80.0, 15.18, 15.40),
    (70.0, 4.38, 4.17),
    (60.0, 0.01, -1.45),
    (50.0, 1.05, 1.49),
    (40.0, 1.76, 3.75),
    (30.0, 0.92, 3.68),
    (20.0, 0.21, 1.82),
    (10.0, 0.07, 1.09),
];
/// Length of the strip, for which its ends are −45 dB relative to its edges.
const LENGTH_M: f64 = 1.0;

fn strip() -> Mesh {
    let half_m = 5.0 * rcs_solvers::WAVELENGTH_M;
    bodies::parallelograms(&[[
        [0.0, -half_m, -0.5 * LENGTH_M],
        [0.0, 2.0 * half_m, 0.0],
        [0.0, 0.0, LENGTH_M],
    ]])
}

/// Physical optics alone.
pub(in crate::study::atlas) fn strip_without_edges(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    strip_rows(methods::BART, Edges::Ignored)
}

/// Physical optics with the fringe currents of its edges.
pub(in crate::study::atlas) fn strip_with_edges(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    strip_rows(methods::EDGES, Edges::FirstOrder)
}

/// A strip of length L has S = L·D/√π, with the 2-D field E = D·e^{−j(kr + π/4)}/√(2πkr).
fn strip_rows(method: Method, edges: Edges) -> Result<Vec<CaseRow>, Failure> {
    let trial = method
        .trial("strip of ten wavelengths, exact series", "field along the edges, degrees from the plane");
    let body = strip();
    let words = "A wave is followed while its current is above a fiftieth";
    let fringes = documented("docs/decisions/edges.md", words)?;
    let row = |(name, polarization, from_plane_deg, db): (&str, Polarization, f64, f64)| {
        let request = RcsRequest {
            edges,
            polarization,
            ..rcs_solvers::first_order_request(90.0 - from_plane_deg, 0.0)
        };
        let result = rcs_solvers::trace_rcs(&body, &request)?;
        let level = LENGTH_M * 10_f64.powf(db / 20.0) / PI.sqrt();
        let error = rcs_solvers::level_error(result.amplitude_m[0].norm(), level);
        let statement = if edges == Edges::Ignored { without_edges(&result) } else { fringes };
        Ok(trial.answered(format!("{name}, {from_plane_deg}"), error, statement))
    };
    let e = STRIP_DB.into_iter().map(|(deg, e, _)| ("E", Polarization::Vv, deg, e));
    let h = STRIP_DB.into_iter().map(|(deg, _, h)| ("H", Polarization::Hh, deg, h));
    e.chain(h).map(row).collect()
}

/// Rays on a plate 10° from its plane: the grid's moiré.
pub(in crate::study::atlas) fn glancing_rays(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::SBR.trial("plate seen 10° from its plane", "rays per wavelength");
    let (body, request) = (bodies::plate(0.1), rcs_solvers::first_order_request(80.0, 0.0));
    let exact = closed_forms::plate_far(0.1, 80_f64.to_radians());
    let row = |per_wavelength: f64| {
        let shooting =
            sbr::RaySettings { per_wavelength, bounces: 1, sides: Sides::Two, bracket: Bracket::Plain };
        let found = rcs_solvers::sbr_amplitudes(&body, &request, &shooting)?[0];
        let statement = ErrorStatement::Remark("error_db is null: a reference is known by its density alone");
        Ok(trial.answered(per_wavelength, rcs_solvers::relative_error(&[found], &[exact]), statement))
    };
    [2.0, 8.0, 32.0].into_iter().map(row).collect()
}
