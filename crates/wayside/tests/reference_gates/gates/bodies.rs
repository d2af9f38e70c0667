//! Meshes of the closed forms, in metres and body axes.

use artifact::scene::Mesh;
use std::f64::consts::PI;
use std::path::Path;

/// Convex polygons as fans of triangles.
pub(crate) fn mesh_of(polygons: &[Vec<[f64; 3]>]) -> Mesh {
    let mut mesh = Mesh::default();
    for polygon in polygons {
        let first = mesh.vertices_m.len() as u32;
        mesh.vertices_m.extend(polygon);
        mesh.triangles.extend((1..polygon.len() as u32 - 1).map(|i| [first, first + i, first + i + 1]));
    }
    mesh.material_of_triangle = vec![0; mesh.triangles.len()];
    mesh.materials = vec![String::new()];
    mesh
}

/// A body of the reference data.
pub(crate) fn stl(file: &Path) -> Mesh {
    scene::read_mesh(file, &scene::MeshOptions { unit_scale: None }).unwrap_or_else(|e| panic!("{e}"))
}

/// A square in the plane x = 0.
pub(crate) fn square(side_m: f64) -> Mesh {
    let h = 0.5 * side_m;
    mesh_of(&[vec![[0.0, -h, -h], [0.0, h, -h], [0.0, h, h], [0.0, -h, h]]])
}

/// A disc in the plane x = 0: a polygon of the same area.
pub(crate) fn disc(radius_m: f64, corners: u32) -> Mesh {
    let step = 2.0 * PI / f64::from(corners);
    let radius_m = radius_m * (step / step.sin()).sqrt();
    let corner = |i| {
        let (sin, cos) = (step * f64::from(i)).sin_cos();
        [0.0, radius_m * cos, radius_m * sin]
    };
    mesh_of(&[(0..corners).map(corner).collect()])
}

/// The half of a cylinder shell about the z axis that faces +x, in flat strips whose mean lies on the
/// surface.
pub(crate) fn half_cylinder(radius_m: f64, length_m: f64, strips: u32) -> Mesh {
    let step = PI / f64::from(strips);
    // Mean sagitta a²/12ρ (docs/physics.md §3).
    let outer_m = radius_m * (1.0 + step * step / 12.0);
    let end = |i: u32, z: f64| {
        let (sin, cos) = (step * f64::from(i) - 0.5 * PI).sin_cos();
        [outer_m * cos, outer_m * sin, z]
    };
    let h = 0.5 * length_m;
    mesh_of(
        &(0..strips).map(|i| vec![end(i, -h), end(i + 1, -h), end(i + 1, h), end(i, h)]).collect::<Vec<_>>(),
    )
}

/// A sphere: an octahedron halved `levels` times, corners on the surface.
pub(crate) fn sphere(radius_m: f64, levels: u32) -> Mesh {
    let tip = |axis: usize, sign: f64| std::array::from_fn(|j| if j == axis { sign } else { 0.0 });
    let mut faces: Vec<[[f64; 3]; 3]> = Vec::new();
    for [a, b, c] in [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]] {
        faces.push([tip(0, a), tip(1, b), tip(2, c)]);
        faces.push([tip(0, -a), tip(2, -c), tip(1, -b)]);
    }
    for _ in 0..levels {
        faces = faces.iter().flat_map(quarters).collect();
    }
    let scaled = |face: &[[f64; 3]; 3]| face.map(|p| p.map(|c| c * radius_m)).to_vec();
    mesh_of(&faces.iter().map(scaled).collect::<Vec<_>>())
}

fn quarters(face: &[[f64; 3]; 3]) -> [[[f64; 3]; 3]; 4] {
    let middle = |i: usize, j: usize| {
        let sum: [f64; 3] = std::array::from_fn(|c| face[i][c] + face[j][c]);
        let length = sum.iter().map(|c| c * c).sum::<f64>().sqrt();
        sum.map(|c| c / length)
    };
    let [ab, bc, ca] = [middle(0, 1), middle(1, 2), middle(2, 0)];
    [[face[0], ab, ca], [ab, face[1], bc], [ca, bc, face[2]], [ab, bc, ca]]
}

/// Two squares that meet at a right angle in the z axis and open to +x.
pub(crate) fn dihedral(side_m: f64) -> Mesh {
    let (h, w) = (0.5 * side_m, side_m / 2.0_f64.sqrt());
    let face = |y: f64| vec![[0.0, 0.0, -h], [w, y, -h], [w, y, h], [0.0, 0.0, h]];
    mesh_of(&[face(w), face(-w)])
}

/// Rim of a trihedral's faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Faces {
    Triangular,
    Square,
}

/// Three faces in the coordinate planes that meet in the origin and open to (1, 1, 1).
pub(crate) fn trihedral(side_m: f64, faces: Faces) -> Mesh {
    let face = |i: usize, j: usize| {
        let at = |u: f64, v: f64| {
            let mut p = [0.0; 3];
            (p[i], p[j]) = (u * side_m, v * side_m);
            p
        };
        match faces {
            Faces::Triangular => vec![at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)],
            Faces::Square => vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)],
        }
    };
    mesh_of(&[face(0, 1), face(1, 2), face(2, 0)])
}
