//! The beam tracer against slow references, and against itself under changes that must not affect the answer.

use crate::study::rcs_solvers;
use crate::study::search::differential_testing::{Outcome, Random, outcome_of};
use crate::study::search::random_bodies::{body, box_of, polarization, request, within, words};
use artifact::material::{Backing, Layer, Material, MeshMaterials, Thickness, Transmission};
use artifact::scene::Mesh;
use artifact::settings::{NodeRule, Sides};
use bart_rcs::{RcsRequest, RcsResult, Standpoint};
use num_complex::Complex64;
use po_sbr::{Bracket, sbr};
use rand::RngExt;
use rand::seq::SliceRandom;
use wayside::host::failure::Failure;

/// Printed errors hold in 95 of 100 cases; twice the printed error is not chance alone.
const BEYOND: f64 = 2.0;

fn printed(result: &RcsResult) -> f64 {
    result.error.total().unwrap_or(0.0)
}

fn sampled(body: &Mesh, request: &RcsRequest, per_wavelength: f64) -> Result<Complex64, Failure> {
    rcs_solvers::po_amplitude(body, request, per_wavelength, (4.0 * per_wavelength) as u32)
}

/// First order of any body, against sampling at two densities, which indicate their own error.
pub(super) fn against_sampling(random: &mut Random) -> Result<Outcome, Failure> {
    let (body, request) = (body(random), request(random, 1));
    let result = rcs_solvers::trace_rcs(&body, &request)?;
    let (coarse, fine) = (sampled(&body, &request, 1.5)?, sampled(&body, &request, 2.5)?);
    let found = result.amplitude_m[0];
    // Below this only rounding is lit.
    if fine.norm() < 1e-9 {
        return Ok(Outcome::Uninformative);
    }
    let allowed = BEYOND * printed(&result) * found.norm() + 4.0 * (coarse - fine).norm();
    Ok(outcome_of((found - fine).norm() / fine.norm(), allowed / fine.norm() + 1e-6, || {
        words(&body, &request)
    }))
}

/// Orders that are compared with rays.
const ORDERS: u8 = 3;

/// Boxes of some faces, for which planes are exact: each order against rays at two densities.
pub(super) fn against_rays(random: &mut Random) -> Result<Outcome, Failure> {
    let body = box_of(random);
    let asked = request(random, ORDERS);
    let request = RcsRequest { nodes: NodeRule::Exit, range_m: f64::INFINITY, ..asked };
    let result = rcs_solvers::trace_rcs(&body, &request)?;
    let rays = |per_wavelength: f64| {
        let shooting = sbr::RaySettings {
            per_wavelength,
            bounces: ORDERS,
            sides: Sides::Two,
            bracket: Bracket::Symmetrised,
        };
        rcs_solvers::sbr_amplitudes(&body, &request, &shooting)
    };
    let (coarse, fine) = (rays(8.0)?, rays(20.0)?);
    let whole = fine.iter().map(|s| s.norm()).sum::<f64>();
    if whole < 1e-6 {
        return Ok(Outcome::Uninformative);
    }
    let missed = |order: usize| (result.by_order_m[order][0] - fine[order]).norm();
    let apart = |order: usize| (coarse[order] - fine[order]).norm();
    let error = (0..ORDERS as usize).map(missed).sum::<f64>() / whole;
    let own = (0..ORDERS as usize).map(apart).sum::<f64>() / whole;
    // Rays that have not converged are uninformative: along a wall there are too few of them.
    if own > 0.1 {
        return Ok(Outcome::Uninformative);
    }
    Ok(outcome_of(error, BEYOND * printed(&result) + 4.0 * own + 0.01, || words(&body, &request)))
}

/// S(tx, rx) and S(rx, tx) of one polarization.
pub(super) fn reciprocity(random: &mut Random) -> Result<Outcome, Failure> {
    let (body, asked) = (body(random), request(random, 2));
    let other = request(random, 2);
    let at = |r: &RcsRequest| Standpoint {
        azimuth_rad: r.azimuth_rad[0],
        elevation_rad: r.elevation_rad[0],
        range_m: r.range_m,
    };
    let forth = RcsRequest { receiver: Some(at(&other)), ..asked.clone() };
    let back = RcsRequest {
        receiver: Some(at(&asked)),
        polarization: asked.polarization,
        accuracy: asked.accuracy,
        ..other
    };
    let (forth_m, back_m) = (rcs_solvers::trace_rcs(&body, &forth)?, rcs_solvers::trace_rcs(&body, &back)?);
    let level = back_m.amplitude_m[0].norm();
    if level < 1e-9 {
        return Ok(Outcome::Uninformative);
    }
    let error = (forth_m.amplitude_m[0] - back_m.amplitude_m[0]).norm() / level;
    let allowed = BEYOND * printed(&forth_m).hypot(printed(&back_m)) + 1e-9;
    Ok(outcome_of(error, allowed, || words(&body, &forth)))
}

/// Triangles in another order, cut at their middles, body and antenna rotated about z.
pub(super) fn mesh_invariance(random: &mut Random) -> Result<Outcome, Failure> {
    let (body, mut request) = (body(random), request(random, 2));
    let result = rcs_solvers::trace_rcs(&body, &request)?;
    let level = result.amplitude_m[0].norm();
    if level < 1e-9 {
        return Ok(Outcome::Uninformative);
    }
    let turn_rad = within(random, -3.0, 3.0);
    let (sin, cos) = turn_rad.sin_cos();
    let mut other = cut(&body);
    other.vertices_m.iter_mut().for_each(|v| *v = [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1], v[2]]);
    other.triangles.shuffle(random);
    request.azimuth_rad[0] += turn_rad;
    let again = rcs_solvers::trace_rcs(&other, &request)?;
    let error = (again.amplitude_m[0] - result.amplitude_m[0]).norm() / level;
    let allowed = BEYOND * printed(&result).hypot(printed(&again)) + 1e-7;
    Ok(outcome_of(error, allowed, || words(&body, &request)))
}

/// Every triangle cut in two from its first corner.
fn cut(body: &Mesh) -> Mesh {
    let mut all = body.clone();
    all.triangles.clear();
    for [a, b, c] in &body.triangles {
        let middle = all.vertices_m.len() as u32;
        let [from, to] = [b, c].map(|i| body.vertices_m[*i as usize]);
        all.vertices_m.push([0, 1, 2].map(|i| 0.5 * (from[i] + to[i])));
        all.triangles.extend([[*a, *b, middle], [*a, middle, *c]]);
    }
    all
}

/// Compares S from ten thousand kilometres, 4e-6 rad of curvature over these bodies, with S from infinity.
pub(super) fn far_field(random: &mut Random) -> Result<Outcome, Failure> {
    let (body, asked) = (body(random), request(random, 3));
    let request = RcsRequest { range_m: f64::INFINITY, ..asked };
    let far = rcs_solvers::trace_rcs(&body, &request)?;
    let near = rcs_solvers::trace_rcs(&body, &RcsRequest { range_m: 1e7, ..request.clone() })?;
    let level = far.amplitude_m[0].norm();
    if level < 1e-6 {
        return Ok(Outcome::Uninformative);
    }
    let error = (near.amplitude_m[0] - far.amplitude_m[0]).norm() / level;
    // The effect of curvature on cancelling parts scales with their size, not with that of the sum.
    let parts = 1e-4 * (1.0 + 1e-2 / level);
    let allowed = BEYOND * printed(&near).hypot(printed(&far)) + parts;
    Ok(outcome_of(error, allowed, || words(&body, &request)))
}

fn material(random: &mut Random) -> Material {
    let count = random.random_range(1..4);
    let layer = |random: &mut Random| Layer {
        thickness_m: within(random, 1e-4, 8e-3),
        permittivity: Complex64::new(within(random, 1.0, 12.0), -within(random, 0.0, 2.0)),
    };
    let layers: Vec<Layer> = (0..count).map(|_| layer(random)).collect();
    match random.random_range(0..3) {
        0 => Material::HalfSpace { permittivity: layers[0].permittivity },
        _ => Material::Layers { layers, backing: Backing::Metal, thickness: Thickness::Exact },
    }
}

/// First order of coated bodies, recursion against characteristic matrices.
pub(super) fn layers(random: &mut Random) -> Result<Outcome, Failure> {
    let mut body = box_of(random);
    let coat = material(random);
    body.materials = vec!["coat".into()];
    body.material_of_triangle = vec![0; body.triangles.len()];
    body.makeup = MeshMaterials { materials: vec![coat.clone()], transmission: Transmission::Ignored };
    let request = RcsRequest { polarization: polarization(random), ..request(random, 1) };
    let result = rcs_solvers::trace_rcs(&body, &request)?;
    let (coarse, fine) = (sampled(&body, &request, 1.5)?, sampled(&body, &request, 2.5)?);
    if fine.norm() < 1e-9 {
        return Ok(Outcome::Uninformative);
    }
    let found = result.amplitude_m[0];
    let allowed = BEYOND * printed(&result) * found.norm() + 4.0 * (coarse - fine).norm();
    let case = || format!("{coat:?}, {}", words(&body, &request));
    Ok(outcome_of((found - fine).norm() / fine.norm(), allowed / fine.norm() + 1e-6, case))
}
