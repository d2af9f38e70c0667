//! The project's own street furniture: poles, signs, guard rails and kerbs, made as prisms in a given size.
//!
//! A piece is turned into a closed [`Mesh`] in body axes, with the same material names as the vehicles. Tubes
//! have facets narrow enough to represent the curved surface (chord over √(ρλ) at most 0.35,
//! `docs/physics.md` §3); facets are as long as the piece.

mod prism;
mod outline;
mod guard_rail;

use artifact::scene::Mesh;
use outline::{circle, kerbstone, rectangle};
use prism::Prisms;

/// Names of the pieces, as used in a scene's `model`.
pub const NAMES: [&str; 4] = ["pole", "sign", "guard-rail", "kerb"];

/// A piece of street furniture and its size, in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Furniture {
    /// An upright steel tube.
    Pole {
        /// Height over the ground.
        height_m: f64,
        /// Diameter of the tube.
        diameter_m: f64,
    },
    /// A plate of aluminium, 0.9 × 0.6 m, in front of the top of a steel tube; it faces x.
    Sign {
        /// Height of its upper edge over the ground.
        height_m: f64,
    },
    /// A corrugated rail of steel on posts along x; it faces y.
    GuardRail {
        /// Length along x.
        length_m: f64,
    },
    /// A kerb of concrete along x.
    Kerb {
        /// Length along x.
        length_m: f64,
    },
}

impl Furniture {
    /// Name of the piece, one of [`NAMES`].
    pub fn name(&self) -> &'static str {
        match self {
            Self::Pole { .. } => NAMES[0],
            Self::Sign { .. } => NAMES[1],
            Self::GuardRail { .. } => NAMES[2],
            Self::Kerb { .. } => NAMES[3],
        }
    }
}

/// Makes the piece, standing on z = 0 around the origin.
pub fn mesh(piece: &Furniture) -> Mesh {
    let mut prisms = Prisms::default();
    match *piece {
        Furniture::Pole { height_m, diameter_m } => {
            prisms.upright(&circle([0.0, 0.0], diameter_m), [0.0, height_m], "steel");
        }
        Furniture::Sign { height_m } => draw_sign(&mut prisms, height_m),
        Furniture::GuardRail { length_m } => guard_rail::draw(&mut prisms, length_m),
        Furniture::Kerb { length_m } => {
            prisms.along(&kerbstone(), [-0.5 * length_m, 0.5 * length_m], "concrete");
        }
    }
    prisms.into_mesh(piece.name())
}

/// Width and height of the plate, its thickness and the tube's diameter (of ISO 4200's series).
const PLATE_M: [f64; 2] = [0.9, 0.6];
const SHEET_M: f64 = 0.003;
const TUBE_M: f64 = 0.0761;

fn draw_sign(prisms: &mut Prisms, height_m: f64) {
    let half = 0.5 * PLATE_M[0];
    prisms.upright(&rectangle([0.0, -half], [SHEET_M, half]), [height_m - PLATE_M[1], height_m], "aluminium");
    // A millimetre of air separates the faces.
    prisms.upright(&circle([-0.5 * TUBE_M - 0.001, 0.0], TUBE_M), [0.0, height_m - 0.05], "steel");
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use std::collections::BTreeMap;

    const PIECES: [Furniture; 4] = [
        Furniture::Pole { height_m: 6.0, diameter_m: 0.114 },
        Furniture::Sign { height_m: 2.85 },
        Furniture::GuardRail { length_m: 8.0 },
        Furniture::Kerb { length_m: 20.0 },
    ];

    fn corners(mesh: &Mesh, t: &[u32; 3]) -> [DVec3; 3] {
        t.map(|i| DVec3::from_array(mesh.vertices_m[i as usize]))
    }

    /// One sixth of the sum of the corners' triple products.
    fn volume_m3(mesh: &Mesh) -> f64 {
        mesh.triangles.iter().map(|t| corners(mesh, t)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }

    #[test]
    fn every_piece_is_closed_and_wound_outwards() {
        for piece in PIECES {
            let mesh = mesh(&piece);
            let mut edges: BTreeMap<[u32; 2], i32> = BTreeMap::new();
            for [a, b, c] in &mesh.triangles {
                for (p, q) in [(a, b), (b, c), (c, a)] {
                    *edges.entry([*p.min(q), *p.max(q)]).or_default() += if p < q { 1 } else { -1 };
                }
            }
            // Each edge is gone along once in either direction.
            assert!(edges.values().all(|n| *n == 0), "{}", mesh.name);
            assert!(volume_m3(&mesh) > 0.0, "{}: {} m³", mesh.name, volume_m3(&mesh));
            let area = |t: &[u32; 3]| {
                let [a, b, c] = corners(&mesh, t);
                0.5 * (b - a).cross(c - a).length()
            };
            assert!(mesh.triangles.iter().all(|t| area(t) > 1e-7), "{}: facets without area", mesh.name);
            println!("{}: {} triangles, {:.4} m³", mesh.name, mesh.triangles.len(), volume_m3(&mesh));
        }
    }

    #[test]
    fn every_piece_stands_on_the_ground_and_has_the_size_asked_for() {
        // Pole: diameter and height; sign: plate before a tube; rail: face 83 mm deep, posts 60 mm behind;
        // kerb: 15 × 12 cm.
        let asked = [[0.114, 0.114, 6.0], [0.0801, 0.9, 2.85], [8.0, 0.1557, 0.75], [20.0, 0.15, 0.12]];
        for (piece, asked) in PIECES.iter().zip(asked) {
            let mesh = mesh(piece);
            let points = || mesh.vertices_m.iter().map(|v| DVec3::from_array(*v));
            let low = points().fold(DVec3::INFINITY, DVec3::min);
            let size = points().fold(DVec3::NEG_INFINITY, DVec3::max) - low;
            assert_eq!(low.z, 0.0, "{}", mesh.name);
            assert!(
                size.abs_diff_eq(DVec3::from_array(asked), 1e-9),
                "{}: asked {asked:?}, got {size}",
                mesh.name
            );
        }
    }

    /// A prism of n sides that has the circle's area is by less than (2π/n)² smaller than the cylinder around
    /// it.
    #[test]
    fn a_pole_has_the_volume_of_its_cylinder_and_chords_that_show_no_facets() {
        let [height_m, diameter_m] = [6.0, 0.114];
        let mesh = mesh(&Furniture::Pole { height_m, diameter_m });
        let sides = mesh.vertices_m.len() as f64 / 2.0;
        let cylinder_m3 = std::f64::consts::PI * 0.25 * diameter_m * diameter_m * height_m;
        let share = volume_m3(&mesh) / cylinder_m3;
        assert!(
            share < 1.0 && 1.0 - share < (std::f64::consts::TAU / sides).powi(2),
            "{share} with {sides} sides"
        );
        let chord_m = diameter_m * (std::f64::consts::PI / sides).sin();
        let q = chord_m / (0.5 * diameter_m * 3.893e-3_f64).sqrt();
        assert!(q <= 0.35, "q = {q}");
    }
}
