//! Sheets and half-spaces: unknown thicknesses, Brewster's angle, bodies behind a pane.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::{documented, printed};
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::bodies;
use crate::study::closed_forms;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use artifact::material::{Backing, Layer, Material, MeshMaterials, Thickness, Transmission};
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use bart_rcs::RcsRequest;
use num_complex::Complex64;
use wayside::host::failure::Failure;

/// Glass at 77 GHz (docs/physics.md §5).
const GLASS: Complex64 = Complex64::new(6.5, -0.15);

/// The body with a single material.
fn made_of(mut body: Mesh, material: Material, transmission: Transmission) -> Mesh {
    body.materials = vec!["glass".into()];
    body.material_of_triangle = vec![0; body.triangles.len()];
    body.makeup = MeshMaterials { materials: vec![material], transmission };
    body
}

fn pane(thickness_m: f64, thickness: Thickness) -> Material {
    Material::Layers {
        layers: vec![Layer { thickness_m, permittivity: GLASS }],
        backing: Backing::Air,
        thickness,
    }
}

/// Reflection r of E and transmission t·e^{jkd} of a slab at normal incidence (docs/physics.md §5).
fn slab(thickness_m: f64) -> [Complex64; 2] {
    let s = GLASS.sqrt();
    let r = (1.0 - s) / (1.0 + s);
    let turn = |thickness_m: f64| (Complex64::new(0.0, -rcs_solvers::K * thickness_m) * s).exp();
    let (once, twice) = (turn(thickness_m), turn(2.0 * thickness_m));
    let all = 1.0 - r * r * twice;
    [r * (1.0 - twice) / all, (1.0 - r * r) * once / all * Complex64::cis(rcs_solvers::K * thickness_m)]
}

/// Panes of 4 to 6 mm at normal incidence: each fraction of a millimetre changes the level.
pub(in crate::study::atlas) fn panes(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("panes of glass, Fresnel's slab", "thickness_mm, told");
    let averaged =
        documented("docs/materials.md", "A pane of 4 to 6 mm reflects between −15.1 and −3.8 dB at 0°")?;
    let row = |(thickness_m, thickness): (f64, Thickness)| {
        let body = made_of(bodies::plate(0.1), pane(thickness_m, thickness), Transmission::Ignored);
        let result = rcs_solvers::trace_rcs(&body, &rcs_solvers::first_order_request(0.0, 0.0))?;
        let exact = -slab(thickness_m)[0] * closed_forms::plate_far(0.1, 0.0);
        let (name, error, statement) = match thickness {
            Thickness::Exact => (
                "exactly",
                rcs_solvers::relative_error(&result.amplitude_m, &[exact]),
                printed(&result.error),
            ),
            Thickness::Averaged => {
                ("about", rcs_solvers::level_error(result.amplitude_m[0].norm(), exact.norm()), averaged)
            }
        };
        Ok(trial.answered(format!("{}, {name}", 1e3 * thickness_m), error, statement))
    };
    let thicknesses_m = [4.0e-3, 4.2e-3, 4.4e-3, 4.6e-3];
    let exactly = thicknesses_m.iter().map(|d| (*d, Thickness::Exact));
    exactly.chain(thicknesses_m.iter().map(|d| (*d, Thickness::Averaged))).map(row).collect()
}

/// A solid wall of glass; its Brewster angle is 68.6°: Kirchhoff's currents have r_TM (of H) for E across the
/// plate's edge, −r_TE along it, times the conductor's.
pub(in crate::study::atlas) fn half_space(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART
        .trial("half-space of glass about its Brewster angle, 68.6°", "polarization, degrees off normal");
    let body =
        made_of(bodies::plate(0.1), Material::HalfSpace { permittivity: GLASS }, Transmission::Ignored);
    let row = |(name, polarization, off_deg): (&str, Polarization, f64)| {
        let request = RcsRequest { polarization, ..rcs_solvers::first_order_request(off_deg, 0.0) };
        let result = rcs_solvers::trace_rcs(&body, &request)?;
        let (sin, cos) = off_deg.to_radians().sin_cos();
        let s = (GLASS - sin * sin).sqrt();
        let factor = match polarization {
            Polarization::Hh => (GLASS * cos - s) / (GLASS * cos + s),
            _ => (s - cos) / (s + cos),
        };
        let exact = factor * closed_forms::plate_far(0.1, off_deg.to_radians());
        let error = rcs_solvers::relative_error(&result.amplitude_m, &[exact]);
        Ok(trial.answered(format!("{name}, {off_deg}"), error, printed(&result.error)))
    };
    let angles = [0.0, 30.0, 68.0, 68.6, 85.0];
    let hh = angles.iter().map(|a| ("hh", Polarization::Hh, *a));
    hh.chain(angles.iter().map(|a| ("vv", Polarization::Vv, *a))).map(row).collect()
}

/// Metal 0.2 m behind a pane: the pane's own echo, and the metal's through the pane twice.
pub(in crate::study::atlas) fn behind_a_pane(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("metal behind a pane of 5 mm", "waves through sheets");
    let (thickness_m, before_m) = (5e-3, 0.2);
    let glass = bodies::shifted(bodies::plate(0.2), [before_m, 0.0, 0.0]);
    let mut body = bodies::joined(glass, &bodies::plate(0.1));
    body.materials = vec!["glass".into(), "metal".into()];
    body.material_of_triangle = vec![0, 0, 1, 1];
    let [reflected, passed] = slab(thickness_m);
    let exact =
        -reflected * closed_forms::plate_far(0.2, 0.0) * Complex64::cis(2.0 * rcs_solvers::K * before_m)
            + passed * passed * closed_forms::plate_far(0.1, 0.0);
    let row = |(name, transmission): (&str, Transmission)| {
        let materials = vec![pane(thickness_m, Thickness::Exact), Material::Conductor];
        let mut asked = body.clone();
        asked.makeup = MeshMaterials { materials, transmission };
        let result = rcs_solvers::trace_rcs(&asked, &rcs_solvers::first_order_request(0.0, 0.0))?;
        let statement =
            result.model_error.transmission.map_or(printed(&result.error), ErrorStatement::Estimate);
        Ok(trial.answered(name, rcs_solvers::relative_error(&result.amplitude_m, &[exact]), statement))
    };
    [("followed", Transmission::Followed), ("ignored", Transmission::Ignored)].into_iter().map(row).collect()
}
