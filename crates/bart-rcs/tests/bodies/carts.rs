//! Small bodies of many kinds of facets: plates, barrels, and carts of both.

use artifact::scene::Mesh;
use std::f64::consts::PI;

pub(crate) fn mesh(vertices_m: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh { vertices_m, triangles, ..Mesh::default() }
}

pub(crate) fn joined(parts: &[Mesh]) -> Mesh {
    let mut all = mesh(vec![], vec![]);
    for part in parts {
        let first = all.vertices_m.len() as u32;
        all.vertices_m.extend_from_slice(&part.vertices_m);
        all.triangles.extend(part.triangles.iter().map(|t| t.map(|i| i + first)));
    }
    all
}

pub(crate) fn parallelogram(corner: [f64; 3], u: [f64; 3], v: [f64; 3]) -> Mesh {
    let add = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| a[i] + b[i]);
    mesh(vec![corner, add(corner, u), add(add(corner, u), v), add(corner, v)], vec![[0, 1, 2], [0, 2, 3]])
}

/// A barrel about an upright axis: curved in two directions, facets of about `size_m`.
pub(crate) fn barrel(centre_m: [f64; 3], radius_m: f64, height_m: f64, size_m: f64) -> Mesh {
    let around = (2.0 * PI * radius_m / size_m).ceil() as u32;
    let rows = (height_m / size_m).ceil() as u32;
    let mut vertices = Vec::new();
    for i in 0..=rows {
        let z = height_m * (f64::from(i) / f64::from(rows) - 0.5);
        let bulge = radius_m * (1.0 - 0.3 * (2.0 * z / height_m).powi(2));
        for j in 0..around {
            let (sin, cos) = (2.0 * PI * f64::from(j) / f64::from(around)).sin_cos();
            vertices.push([centre_m[0] + bulge * cos, centre_m[1] + bulge * sin, centre_m[2] + z]);
        }
    }
    let index = |i: u32, j: u32| i * around + j % around;
    let square = |i: u32, j: u32| {
        let [a, b, c, d] = [index(i, j), index(i, j + 1), index(i + 1, j + 1), index(i + 1, j)];
        [[a, b, c], [a, c, d]]
    };
    let triangles = (0..rows).flat_map(|i| (0..around).flat_map(move |j| square(i, j))).collect();
    mesh(vertices, triangles)
}

/// A cart: a deck, an upright wall, barrels. Facets large and small, one to three bounces, shadows.
pub(crate) fn cart(wall_lean: f64) -> Mesh {
    joined(&[
        parallelogram([-0.8, -0.5, 0.3], [1.6, 0.0, 0.0], [0.0, 1.0, 0.0]),
        parallelogram([-0.2, -0.5, 0.3], [0.0, 1.0, 0.0], [wall_lean, 0.0, 0.7]),
        barrel([0.45, 0.15, 0.55], 0.2, 0.4, 0.1),
        barrel([0.3, -0.3, 0.5], 0.12, 0.3, 0.08),
    ])
}
