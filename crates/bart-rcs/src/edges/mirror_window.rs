//! Field behind a mirror of finite size: the reflection of a flat patch to a point, with the Fresnel
//! transition at its edges.
//!
//! The reflected wave arrives at x as from the image, through the point of the patch between them. Near the
//! edge of the patch the field changes from full to zero as behind any straight edge:
//!
//! ```text
//! Φ = 1 − ½ e^{−jkδ} W(√(kδ)) inside      ½ e^{−jkδ} W(√(kδ)) outside
//! ```
//! with δ the detour via the edge, exactly: the minimum length via it less that via the mirror point, and W
//! of [`crate::edges::fresnel`]. On the edge itself, as on the fold of a corner, it is ½. Only the nearest
//! edge, by its detour, is taken. (Ufimtsev ch. 3 for the half-plane; the window of a patch is ours,
//! docs/decisions/node-rule.md.)

use crate::bodies::world::World;
use crate::edges::fresnel::edge_wave;
use crate::geometry::antenna::Antenna;
use crate::geometry::plane::Plane;
use crate::geometry::plane_frame::PlaneFrame;
use crate::integral::field::length_difference_m;
use glam::{DVec2, DVec3};
use num_complex::Complex64;

/// A flat patch with its outline.
#[derive(Debug, Clone)]
pub(crate) struct FlatPatch {
    pub(crate) facets: Vec<u32>,
    pub(crate) plane: Plane,
    pub(crate) frame: PlaneFrame,
    pub(crate) outline: Vec<OutlineSide>,
    pub(crate) area_m2: f64,
    tolerance_m: f64,
}

/// A side of a patch's outline.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OutlineSide {
    pub(crate) ends_m: [DVec3; 2],
    /// Unit vector in the patch's plane, pointing out of the patch.
    pub(crate) outward: DVec3,
    /// Facet beyond the side, if there is exactly one.
    pub(crate) beyond: Option<u32>,
    ends_in_plane_m: [DVec2; 2],
}

/// Position of a point behind a mirror.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Window {
    /// The mirror point lies on the patch; with the detour via its nearest edge, m.
    Inside(f64),
    /// The mirror point lies beside the patch.
    Outside(f64),
    /// There is no mirror point: the point is behind the mirror.
    Dark,
}

impl Window {
    /// Field there relative to that of an unbounded mirror.
    pub(crate) fn field(self, wavenumber_per_m: f64) -> Complex64 {
        let half = |detour_m: f64| {
            let phase_rad = wavenumber_per_m * detour_m;
            0.5 * edge_wave(phase_rad.sqrt()) * Complex64::cis(-phase_rad)
        };
        match self {
            Self::Inside(detour_m) => 1.0 - half(detour_m),
            Self::Outside(detour_m) => half(detour_m),
            Self::Dark => Complex64::ZERO,
        }
    }

    pub(crate) fn detour_m(self) -> f64 {
        match self {
            Self::Inside(detour_m) | Self::Outside(detour_m) => detour_m,
            Self::Dark => 0.0,
        }
    }
}

impl FlatPatch {
    /// Patch of coplanar facets.
    pub(crate) fn of(world: &World, facets: Vec<u32>) -> Self {
        let largest = facets.iter().copied().fold(facets[0], |best, facet| {
            if world.facet(facet).area_m2 > world.facet(best).area_m2 { facet } else { best }
        });
        let plane = world.facet(largest).plane;
        let frame = PlaneFrame::new(world.facet(largest).corners_m[0], plane.normal);
        let sides = |&facet: &u32| (0..3).filter_map(move |side| side_of(world, &frame, facet, side));
        Self {
            outline: facets.iter().flat_map(sides).collect(),
            area_m2: facets.iter().map(|&facet| world.facet(facet).area_m2).sum(),
            tolerance_m: world.tolerance_m(),
            plane,
            frame,
            facets,
        }
    }

    /// Position of `x_m` behind the patch as a mirror of `antenna`.
    pub(crate) fn window(&self, antenna: Antenna, x_m: DVec3) -> Window {
        let Some(mirror_m) = self.mirror_point_m(antenna.mirrored(&self.plane), x_m) else {
            return Window::Dark;
        };
        let detours = self.outline.iter().map(|side| side.detour_m(antenna, mirror_m, x_m));
        let least_m = detours.fold(f64::INFINITY, f64::min).max(0.0);
        if self.holds(mirror_m) { Window::Inside(least_m) } else { Window::Outside(least_m) }
    }

    /// Intersection of the straight line from an image to `x_m` with the plane; `None` if there is none.
    pub(crate) fn mirror_point_m(&self, image: Antenna, x_m: DVec3) -> Option<DVec3> {
        let distance_m = self.plane.distance_m(x_m);
        if distance_m.abs() <= self.tolerance_m {
            return Some(x_m);
        }
        let towards = image.towards(x_m);
        let share = -distance_m / self.plane.normal.dot(towards);
        (share.is_finite() && share > 0.0).then(|| x_m + share * towards)
    }

    /// Whether a point of the plane lies on the patch (by crossing number).
    fn holds(&self, x_m: DVec3) -> bool {
        let x = self.frame.plane_from_world(x_m);
        let crosses = |side: &&OutlineSide| {
            let [a, b] = side.ends_in_plane_m;
            (a.y > x.y) != (b.y > x.y) && x.x < a.x + (x.y - a.y) * (b.x - a.x) / (b.y - a.y)
        };
        self.outline.iter().filter(crosses).count() % 2 == 1
    }
}

fn side_of(world: &World, frame: &PlaneFrame, facet: u32, side: usize) -> Option<OutlineSide> {
    if world.is_inside_patch(facet, side) {
        return None;
    }
    let of = world.facet(facet);
    let ends_m = [of.corners_m[side], of.corners_m[(side + 1) % 3]];
    let outward = (ends_m[1] - ends_m[0]).cross(of.normal()).try_normalize()?;
    Some(OutlineSide {
        ends_m,
        outward,
        beyond: world.across(facet, side).map(|(beyond, _)| beyond),
        ends_in_plane_m: ends_m.map(|x| frame.plane_from_world(x)),
    })
}

impl OutlineSide {
    /// Minimum length from an antenna via the side to `x_m`, less that via `mirror_m`.
    fn detour_m(&self, antenna: Antenna, mirror_m: DVec3, x_m: DVec3) -> f64 {
        let over_m = self.shortest_over_m(antenna, x_m);
        let to_x_m = over_m.distance(x_m) - mirror_m.distance(x_m);
        length_difference_m(antenna, over_m, mirror_m) + to_x_m
    }

    /// Point of the side on the shortest path, where both angles with the side are equal.
    fn shortest_over_m(&self, antenna: Antenna, x_m: DVec3) -> DVec3 {
        let [from, to] = self.ends_m;
        let length_m = from.distance(to);
        let along = (to - from) / length_m;
        let place = |p: DVec3| ((p - from).dot(along), (p - from).cross(along).length());
        let (x_at_m, x_off_m) = place(x_m);
        let at_m = match antenna {
            Antenna::Point(p) => {
                let (p_at_m, p_off_m) = place(p);
                let off_m = p_off_m + x_off_m;
                if off_m > 0.0 { (p_at_m * x_off_m + x_at_m * p_off_m) / off_m } else { x_at_m }
            }
            Antenna::Direction(r) => {
                let cosine = r.dot(along);
                x_at_m + x_off_m * cosine / (1.0 - cosine * cosine).max(f64::MIN_POSITIVE).sqrt()
            }
        };
        from + along * at_m.clamp(0.0, length_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::scene::Mesh;

    /// A square of 2 m in the plane z = 0, of two triangles.
    fn square() -> FlatPatch {
        let corner = |x: f64, y: f64| [x, y, 0.0];
        let vertices_m = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        let mesh = Mesh { vertices_m, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
        FlatPatch::of(&World::of_mesh(&mesh).unwrap(), vec![0, 1])
    }

    #[test]
    fn a_square_has_four_sides_and_holds_what_is_inside_them() {
        let patch = square();
        assert_eq!((patch.outline.len(), patch.area_m2), (4, 4.0));
        let middle_m = |side: &OutlineSide| 0.5 * (side.ends_m[0] + side.ends_m[1]);
        assert!(patch.outline.iter().all(|side| (side.outward - middle_m(side)).length() < 1e-15));
        assert!(patch.holds(DVec3::new(0.9, -0.99, 0.0)) && !patch.holds(DVec3::new(1.01, 0.2, 0.0)));
    }

    #[test]
    fn the_detour_is_the_least_over_the_edge_of_all_that_are_tried() {
        let patch = square();
        let x_m = DVec3::new(-0.7, 0.1, 0.6);
        let places = [
            Antenna::Point(DVec3::new(3.0, 1.0, 2.0)),
            Antenna::Point(DVec3::new(0.5, 0.4, 0.3)),
            Antenna::Direction(DVec3::new(0.36, 0.48, 0.8)),
        ];
        for antenna in places {
            let over = |at: DVec3| antenna.path_length_m(at) + at.distance(x_m);
            let mirror_m = patch.mirror_point_m(antenna.mirrored(&patch.plane), x_m).unwrap();
            assert!((over(mirror_m) - antenna.mirrored(&patch.plane).path_length_m(x_m)).abs() < 1e-14);
            for side in &patch.outline {
                let at = |i: u32| side.ends_m[0].lerp(side.ends_m[1], f64::from(i) / 1e4);
                let least_m = (0..=10_000).map(|i| over(at(i))).fold(f64::INFINITY, f64::min);
                let got_m = side.detour_m(antenna, mirror_m, x_m) + over(mirror_m);
                // Lengths are stationary there: a ten-thousandth off is 1e-8 longer.
                assert!((got_m - least_m).abs() < 2e-8 && got_m < least_m + 1e-15, "{got_m} {least_m}");
            }
        }
    }

    #[test]
    fn the_field_is_whole_inside_half_on_the_edge_and_gone_outside() {
        let patch = square();
        let straight = Antenna::Direction(DVec3::Z);
        let field = |x: f64, z: f64| patch.window(straight, DVec3::new(x, 0.0, z)).field(1613.8);
        assert!((field(0.0, 0.1) - 1.0).norm() < 0.02 && field(2.0, 0.1).norm() < 0.02);
        assert!((field(1.0, 0.1) - 0.5).norm() < 1e-6);
        let steps = [field(1.0 - 1e-9, 0.1), field(1.0 + 1e-9, 0.1)];
        assert!((steps[0] - steps[1]).norm() < 1e-5, "{steps:?}");
        // Both signs of the normal: the other side of a sheet is a mirror for antennas there.
        assert_eq!(patch.window(straight, DVec3::new(0.0, 0.0, -0.1)), Window::Dark);
    }

    #[test]
    fn the_edge_of_a_mirror_is_that_of_kirchhoffs_half_plane() {
        let patch = square();
        // 0.2 m before the mirror, at normal incidence: (1 + j)/2 ∫ e^{−jπt²/2} dt, t from −√(2/λz)·(distance
        // inside) on; by the trapezoidal rule with a Gaussian end.
        let (k, z) = (1613.8, 0.2);
        for inside_m in [-0.02, -0.004, 0.003, 0.01, 0.03] {
            let got = patch.window(Antenna::Direction(DVec3::Z), DVec3::new(1.0 - inside_m, 0.0, z)).field(k);
            let step = 1e-5;
            let term = |i: i32| {
                let t = -inside_m + f64::from(i) * step;
                Complex64::cis(-k * t * t / (2.0 * z)) * (-(t / 0.5).powi(8)).exp()
            };
            let sum: Complex64 = (0..80_000).map(term).sum::<Complex64>() - 0.5 * term(0);
            let whole = Complex64::cis(-std::f64::consts::FRAC_PI_4) * (std::f64::consts::TAU * z / k).sqrt();
            let asked = sum * step / whole;
            println!("{inside_m} m inside: asked {asked:.4}, got {got:.4}");
            // The detour is √(z² + d²) − z where Kirchhoff's parabola has d²/2z: d⁴/8z³ less.
            let turned_rad = k * inside_m.powi(4) / (8.0 * z.powi(3));
            assert!((got - asked).norm() < 1e-3 + 0.5 * turned_rad);
        }
    }
}
