//! Concave skins: caustics of one reflection, and interior bounces.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::printed;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::bodies;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use artifact::scene::Mesh;
use artifact::settings::{NodeRule, Sides};
use bart_rcs::RcsRequest;
use num_complex::Complex64;
use po_sbr::{Bracket, sbr};
use std::f64::consts::PI;
use wayside::host::failure::Failure;

const RADIUS_M: f64 = 0.3;
/// Tangent of half the angle of the mirror seen from its centre.
const HALF: f64 = 0.1;

/// A spherical mirror with its pole at the origin and its centre on +x.
fn mirror(cells: u32) -> Mesh {
    let mut all = bodies::mesh(vec![], vec![]);
    let at = |i: u32| HALF * (2.0 * f64::from(i) / f64::from(cells) - 1.0);
    for (i, j) in (0..=cells).flat_map(|i| (0..=cells).map(move |j| (i, j))) {
        let (y, z) = (at(i), at(j));
        let scale = RADIUS_M / (1.0 + y * y + z * z).sqrt();
        all.vertices_m.push([RADIUS_M - scale, y * scale, z * scale]);
    }
    for (i, j) in (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))) {
        let corner = |i: u32, j: u32| i * (cells + 1) + j;
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        all.triangles.extend([[a, b, c], [a, c, d]]);
    }
    all
}

/// The whole mirror is in phase from its centre: S = j√(4π)·A/λ, where geometrical optics is infinite.
pub(in crate::study::atlas) fn mirror_from_its_centre(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("hollow mirror seen from its centre (a caustic)", "q of the facets");
    let area_m2 = 4.0 * (HALF * HALF / (1.0 + 2.0 * HALF * HALF).sqrt()).atan() * RADIUS_M * RADIUS_M;
    let exact = Complex64::new(0.0, (4.0 * PI).sqrt() * area_m2 / rcs_solvers::WAVELENGTH_M);
    let row = |q: f64| {
        let chord_m = q * (RADIUS_M * rcs_solvers::WAVELENGTH_M).sqrt();
        let cells = (2.0 * HALF * RADIUS_M / chord_m).round() as u32;
        let request = RcsRequest { range_m: RADIUS_M, ..rcs_solvers::first_order_request(0.0, 0.0) };
        let result = rcs_solvers::trace_rcs(&mirror(cells), &request)?;
        let statement = match result.error.tessellation {
            None => ErrorStatement::Remark("error_db.tessellation is null: facets are taken as the surface"),
            Some(_) => printed(&result.error),
        };
        Ok(trial.answered(q, rcs_solvers::relative_error(&result.amplitude_m, &[exact]), statement))
    };
    [0.1, 0.25, 0.5].into_iter().map(row).collect()
}

/// The same facets against dense sampling, at the places where rays cross.
pub(in crate::study::atlas) fn mirror_from_its_focus(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("hollow mirror about its focus, dense sampling", "range over radius");
    let body = mirror(18);
    let row = |share: f64| {
        let request = RcsRequest { range_m: share * RADIUS_M, ..rcs_solvers::first_order_request(1.0, 0.5) };
        let result = rcs_solvers::trace_rcs(&body, &request)?;
        let exact = rcs_solvers::po_amplitude(&body, &request, 4.0, 0)?;
        Ok(trial.answered(
            share,
            rcs_solvers::relative_error(&result.amplitude_m, &[exact]),
            printed(&result.error),
        ))
    };
    [0.5, 0.75, 1.0, 1.5].into_iter().map(row).collect()
}

/// Half of an upright tube, open towards +x.
fn trough(radius_m: f64, height_m: f64, sides: u32) -> Mesh {
    let wall = |i: u32| {
        let at = |i: u32| {
            let angle = PI * (0.5 + f64::from(i) / f64::from(sides));
            [radius_m * angle.cos(), radius_m * angle.sin(), -0.5 * height_m]
        };
        let (a, b) = (at(i), at(i + 1));
        [a, [b[0] - a[0], b[1] - a[1], 0.0], [0.0, 0.0, height_m]]
    };
    bodies::parallelograms(&(0..sides).map(wall).collect::<Vec<_>>())
}

/// Waves along a concave wall bounce many times; each order relative to the whole of S, rays 30 per
/// wavelength with the same node.
pub(in crate::study::atlas) fn trough_of_orders(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("half tube from inside, rays of the same order", "azimuth_deg, order");
    let body = trough(0.05, 0.05, 90);
    let mut rows = Vec::new();
    for azimuth_deg in [10.0, 40.0] {
        let request =
            RcsRequest { nodes: NodeRule::Exit, ..rcs_solvers::request_with_bounces(azimuth_deg, 0.0, 3) };
        let result = rcs_solvers::trace_rcs(&body, &request)?;
        let shooting = sbr::RaySettings {
            per_wavelength: 30.0,
            bounces: 3,
            sides: Sides::Two,
            bracket: Bracket::Symmetrised,
        };
        let rays = rcs_solvers::sbr_amplitudes(&body, &request, &shooting)?;
        let whole = rays.iter().sum::<Complex64>().norm();
        for (order, ((found, rays), spread)) in
            (1..).zip(result.by_order_m.iter().zip(&rays).zip(&result.node_spread))
        {
            let error = (found[0] - rays).norm() / whole;
            rows.push(trial.answered(
                format!("{azimuth_deg}, {order}"),
                error,
                ErrorStatement::Estimate(*spread),
            ));
        }
    }
    Ok(rows)
}
