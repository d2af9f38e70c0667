//! Small bodies with closed forms, body axes.

use artifact::scene::Mesh;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Corner, and two edges.
pub(super) type Parallelogram = [[f64; 3]; 3];

pub(super) fn mesh(vertices_m: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh { vertices_m, triangles, ..Mesh::default() }
}

/// Mesh of parallelograms, two triangles each.
pub(super) fn parallelograms(list: &[Parallelogram]) -> Mesh {
    let mut all = mesh(vec![], vec![]);
    for [o, u, v] in list {
        let first = all.vertices_m.len() as u32;
        let add = |a: &[f64; 3], b: &[f64; 3]| [0, 1, 2].map(|i| a[i] + b[i]);
        all.vertices_m.extend([*o, add(o, u), add(&add(o, u), v), add(o, v)]);
        all.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    all
}

/// Joins two meshes into one.
pub(super) fn joined(mut a: Mesh, b: &Mesh) -> Mesh {
    let first = a.vertices_m.len() as u32;
    a.vertices_m.extend(&b.vertices_m);
    a.triangles.extend(b.triangles.iter().map(|t| t.map(|i| i + first)));
    a
}

pub(super) fn shifted(mut body: Mesh, by_m: [f64; 3]) -> Mesh {
    body.vertices_m.iter_mut().for_each(|v| *v = [0, 1, 2].map(|i| v[i] + by_m[i]));
    body
}

/// A square plate facing +x, centred on the origin.
pub(super) fn plate(side_m: f64) -> Mesh {
    let h = 0.5 * side_m;
    parallelograms(&[[[0.0, -h, -h], [0.0, side_m, 0.0], [0.0, 0.0, side_m]]])
}

/// The same plate as horizontal strips between these heights, as shares of its side from 0 to 1.
pub(super) fn plate_in_strips(side_m: f64, heights: &[f64]) -> Mesh {
    let h = 0.5 * side_m;
    let strip =
        |w: &[f64]| [[0.0, -h, side_m * w[0] - h], [0.0, side_m, 0.0], [0.0, 0.0, side_m * (w[1] - w[0])]];
    parallelograms(&heights.windows(2).map(strip).collect::<Vec<_>>())
}

/// A square floor facing up at z = 0, centred on the origin.
pub(super) fn floor(side_m: f64) -> Mesh {
    let h = 0.5 * side_m;
    parallelograms(&[[[-h, -h, 0.0], [side_m, 0.0, 0.0], [0.0, side_m, 0.0]]])
}

/// Faces of a cube by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Face {
    Front,
    Back,
    Left,
    Right,
    Top,
    Bottom,
}

impl Face {
    pub(super) const ALL: [Self; 6] =
        [Self::Front, Self::Back, Self::Left, Self::Right, Self::Top, Self::Bottom];

    /// Parallelogram of this face of the unit cube on the floor, facing outward.
    fn unit(self) -> Parallelogram {
        let (low, high) = (-0.5, 0.5);
        let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        match self {
            Self::Front => [[high, low, 0.0], y, z],
            Self::Back => [[low, low, 0.0], z, y],
            Self::Left => [[low, high, 0.0], z, x],
            Self::Right => [[low, low, 0.0], x, z],
            Self::Top => [[low, low, 1.0], x, y],
            Self::Bottom => [[low, low, 0.0], y, x],
        }
    }
}

/// A cube on the floor with only these faces.
pub(super) fn cube(side_m: f64, faces: &[Face]) -> Mesh {
    let scaled = |p: Parallelogram| p.map(|v| v.map(|c| side_m * c));
    parallelograms(&faces.iter().map(|f| scaled(f.unit())).collect::<Vec<_>>())
}

/// Two plates 0.15 m × 0.15 m that open towards +x with this angle between them, the fold along z through the
/// origin.
pub(super) fn dihedral(angle_deg: f64) -> Mesh {
    let (a, half) = (0.15, 0.5 * angle_deg.to_radians());
    let wall = |side: f64| [a * half.cos(), side * a * half.sin(), 0.0];
    parallelograms(&[
        [[0.0, 0.0, -0.5 * a], [0.0, 0.0, a], wall(1.0)],
        [[0.0, 0.0, -0.5 * a], wall(-1.0), [0.0, 0.0, a]],
    ])
}

/// Three squares in the coordinate planes, apex at the origin, open towards (1, 1, 1).
pub(super) fn square_trihedral(side_m: f64) -> Mesh {
    let axis = |i: usize| std::array::from_fn(|j| if i == j { side_m } else { 0.0 });
    parallelograms(&[(0, 1), (1, 2), (2, 0)].map(|(i, j)| [[0.0; 3], axis(i), axis(j)]))
}

/// Three triangles, each half of a square trihedral's side, towards its apex.
pub(super) fn triangular_trihedral(side_m: f64) -> Mesh {
    let tips = (0..3).map(|i| std::array::from_fn(|j| if i == j { side_m } else { 0.0 }));
    mesh(std::iter::once([0.0; 3]).chain(tips).collect(), vec![[0, 1, 2], [0, 2, 3], [0, 3, 1]])
}

/// Wall of an upright cylinder from z = 0, vertices on the circle, rotated by `turn` of a facet.
pub(super) fn tube(radius_m: f64, height_m: f64, sides: u32, turn: f64) -> Mesh {
    let mut all = mesh(vec![], vec![]);
    for i in 0..sides {
        let angle = TAU * (f64::from(i) + turn) / f64::from(sides);
        let [x, y] = [radius_m * angle.cos(), radius_m * angle.sin()];
        all.vertices_m.extend([[x, y, 0.0], [x, y, height_m]]);
        let next = (i + 1) % sides;
        let [a, b, c, d] = [2 * i, 2 * next, 2 * next + 1, 2 * i + 1];
        all.triangles.extend([[a, b, c], [a, c, d]]);
    }
    all
}

/// A cylinder with a lid on a floor.
pub(super) fn top_hat(radius_m: f64, height_m: f64, sides: u32, floor_m: f64) -> Mesh {
    let mut hat = tube(radius_m, height_m, sides, 0.0);
    let centre = hat.vertices_m.len() as u32;
    hat.vertices_m.push([0.0, 0.0, height_m]);
    hat.triangles.extend((0..sides).map(|i| [centre, 2 * i + 1, 2 * ((i + 1) % sides) + 1]));
    joined(hat, &floor(floor_m))
}

/// A sphere from the faces of a cube, each cut into `cells`² squares of equal angle and these into two
/// triangles, with its vertices moved outwards so that the facets' mean is on the sphere (a right triangle
/// with legs e is e²/12 of a radius below it).
pub(super) fn sphere(radius_m: f64, cells: u32) -> Mesh {
    let edge = FRAC_PI_2 / f64::from(cells);
    let raised = radius_m * (1.0 + edge * edge / 12.0);
    let mut all = mesh(vec![], vec![]);
    for face in 0..6 {
        let first = all.vertices_m.len() as u32;
        for (i, j) in (0..=cells).flat_map(|i| (0..=cells).map(move |j| (i, j))) {
            all.vertices_m.push(on_sphere(face, [i, j], cells).map(|c| raised * c));
        }
        for (i, j) in (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))) {
            let corner = |i: u32, j: u32| first + i * (cells + 1) + j;
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            all.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    all
}

/// Unit vector to a vertex on one of the cube's faces.
fn on_sphere(face: usize, [i, j]: [u32; 2], cells: u32) -> [f64; 3] {
    let coordinate = |i: u32| (0.5 * FRAC_PI_2 * (2.0 * f64::from(i) / f64::from(cells) - 1.0)).tan();
    let (axis, side) = (face % 3, if face < 3 { 1.0 } else { -1.0 });
    let mut x = [0.0; 3];
    x[axis] = side;
    x[(axis + 1) % 3] = side * coordinate(i);
    x[(axis + 2) % 3] = coordinate(j);
    let length = x.iter().map(|c| c * c).sum::<f64>().sqrt();
    x.map(|c| c / length)
}
