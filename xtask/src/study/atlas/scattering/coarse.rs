//! Meshes of too few polygons: their flat facets point elsewhere, and the level is many decibels too low.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::documented;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::bodies;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use artifact::Accuracy;
use artifact::scene::Mesh;
use artifact::settings::Surface;
use bart_rcs::RcsRequest;
use std::f64::consts::PI;
use wayside::host::failure::Failure;

/// Documented limit of a skin defined by few vertices.
const SKIN: &str = "Normals from a mesh of irregular triangles are as good as the mesh.";
/// Half axes of a smooth body with a small car's proportions.
const HALF_M: [f64; 3] = [0.4, 0.18, 0.14];

fn ellipsoid(cells: u32) -> Mesh {
    let mut body = bodies::sphere(1.0, cells);
    body.vertices_m.iter_mut().for_each(|v| *v = [0, 1, 2].map(|i| HALF_M[i] * v[i]));
    body
}

/// |S| by geometrical optics: σ = πa²b²c²/(a²ξ² + b²η² + c²ζ²)².
fn smooth_level(azimuth_rad: f64, elevation_rad: f64) -> f64 {
    let ((sin_az, cos_az), (sin_el, cos_el)) = (azimuth_rad.sin_cos(), elevation_rad.sin_cos());
    let towards = [cos_el * cos_az, cos_el * sin_az, sin_el];
    let square: f64 = (0..3).map(|i| (HALF_M[i] * towards[i]).powi(2)).sum();
    PI.sqrt() * HALF_M.iter().product::<f64>() / square
}

/// Mean error of the levels over 24 aspects: the mean of |20·log₁₀| as an amplitude.
pub(in crate::study::atlas) fn few_polygons(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial =
        methods::BART.trial("smooth body of few polygons, mean |dB| of 24 aspects", "surface, triangles");
    let skin = documented("docs/decisions/curved-skin.md", SKIN)?;
    let row = |(name, surface, cells): (&str, Surface, u32)| {
        let body = ellipsoid(cells);
        let request = RcsRequest {
            azimuth_rad: (0..24).map(|i| (3.0 + 7.3 * f64::from(i)).to_radians()).collect(),
            surface,
            accuracy: Accuracy::from_db(-20.0),
            ..rcs_solvers::first_order_request(0.0, 10.0)
        };
        let result = rcs_solvers::trace_rcs(&body, &request)?;
        let exact = request.azimuth_rad.iter().map(|az| smooth_level(*az, request.elevation_rad[0]));
        let miss_db = |(s, level): (&num_complex::Complex64, f64)| (20.0 * (s.norm() / level).log10()).abs();
        let mean_db = result.amplitude_m.iter().zip(exact).map(miss_db).sum::<f64>() / 24.0;
        let statement = match result.error.tessellation {
            None => ErrorStatement::Remark("error_db.tessellation is null: facets are taken as the surface"),
            // The bound is that of the skin defined by the vertices, which are too few to define it
            // accurately.
            Some(_) => skin,
        };
        let error = 10_f64.powf(mean_db / 20.0) - 1.0;
        Ok(trial.answered(format!("{name}, {}", body.triangles.len()), error, statement))
    };
    [
        ("flat", Surface::Flat, 4),
        ("flat", Surface::Flat, 8),
        ("flat", Surface::Flat, 24),
        ("flat", Surface::Flat, 48),
        ("smooth", Surface::Smooth, 8),
        ("smooth", Surface::Smooth, 24),
    ]
    .into_iter()
    .map(row)
    .collect()
}
