//! Surface formed by a set of triangles: its lines, the facets around each, and the flat patches.
//!
//! Corners within a tolerance are one point, a side that passes the corners of its neighbours is cut there,
//! and connected coplanar triangles are one patch. It is defined for any mesh: open, doubled, with
//! T-junctions or with many facets at one line.

use crate::geometry::plane::Plane;
use crate::mesh::mesh_edges::{MeshEdge, MeshEdges, TriangleSide, parts};
use crate::mesh::t_junction::{CornerTolerance, cut_at_corners};
use crate::mesh::welding::Welding;
use glam::DVec3;
use std::f64::consts::TAU;

/// Angle around a common side within which facets lie on each other: 1 mm over 1 m.
const DOUBLED_RAD: f64 = 1e-3;
/// Maximum angle between the normals of facets of one patch.
const FLAT_RAD: f64 = 0.5 * std::f64::consts::PI / 180.0;

/// The surface of a mesh.
pub(crate) struct Topology<'a> {
    triangles_m: &'a [[DVec3; 3]],
    edges: MeshEdges,
    /// Unit normals of triangles by winding; zero without a plane.
    normals: Vec<DVec3>,
    patch_of: Vec<u32>,
    patches: u32,
}

/// Directions of the facets at a line, perpendicular to it and away from it, by their angle around it.
pub(crate) struct Fan {
    /// Unit vector along the line.
    pub(crate) along: DVec3,
    /// Facets, of which those that lie on each other are one.
    pub(crate) blades: Vec<FanFacet>,
}

/// A facet at a line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FanFacet {
    /// Angle around the line, from the first blade.
    pub(crate) angle_rad: f64,
    /// Unit vector in the facet, away from the line.
    pub(crate) inward: DVec3,
    pub(crate) side: TriangleSide,
}

impl<'a> Topology<'a> {
    /// Topology of triangles in one frame; corners within rounding are one.
    pub(crate) fn of(triangles_m: &'a [[DVec3; 3]], near: CornerTolerance) -> Self {
        let tolerance_m = near.rounding_m;
        let points_m = triangles_m.as_flattened();
        let names = Welding::Within(tolerance_m).places(points_m);
        let (names, _) = names.as_chunks::<3>();
        let normals: Vec<DVec3> = triangles_m.iter().map(|t| normal_of(t, tolerance_m)).collect();
        let with_plane = |(names, normal): (&[u32; 3], &DVec3)| (*normal != DVec3::ZERO).then_some(*names);
        let places: Vec<Option<[u32; 3]>> = names.iter().zip(&normals).map(with_plane).collect();
        let mut parts = parts(&places);
        cut_at_corners(&mut parts, points_m, near);
        let edges = MeshEdges::of_parts(parts, triangles_m.len());
        let mut topology = Self { triangles_m, edges, normals, patch_of: Vec::new(), patches: 0 };
        topology.grow_patches(near);
        topology
    }

    /// Facets that share a line, for every line.
    pub(crate) fn lines(&self) -> impl Iterator<Item = MeshEdge<'_>> {
        self.edges.iter()
    }

    /// Ends of a line.
    pub(crate) fn ends_m(&self, line: &MeshEdge<'_>) -> [DVec3; 2] {
        line.ends.map(|corner| self.triangles_m.as_flattened()[corner as usize])
    }

    /// Flat patch of a triangle that has a plane.
    pub(crate) fn patch_of(&self, triangle: u32) -> u32 {
        self.patch_of[triangle as usize]
    }

    /// Number of patches.
    pub(crate) fn patches(&self) -> usize {
        self.patches as usize
    }

    /// Normal of a triangle by winding; zero without a plane.
    pub(crate) fn normal(&self, triangle: u32) -> DVec3 {
        self.normals[triangle as usize]
    }

    /// Whether a line lies inside one patch, with facets on both sides.
    pub(crate) fn is_inside_a_patch(&self, line: &MeshEdge<'_>) -> bool {
        let patch = self.patch_of(line.sides[0].triangle);
        let same = line.sides.iter().all(|side| self.patch_of(side.triangle) == patch);
        same && self.fan(line).is_some_and(|fan| fan.blades.len() > 1)
    }

    /// Facets around a line; `None` if its ends are one point.
    pub(crate) fn fan(&self, line: &MeshEdge<'_>) -> Option<Fan> {
        let [a, b] = self.ends_m(line);
        let along = (b - a).try_normalize()?;
        let first = self.inward(&line.sides[0], along)?;
        let up = along.cross(first);
        let mut blades: Vec<FanFacet> = Vec::with_capacity(line.sides.len());
        for side in line.sides {
            let inward = self.inward(side, along)?;
            let angle = inward.dot(up).atan2(inward.dot(first));
            let angle_rad = if angle < -DOUBLED_RAD { angle + TAU } else { angle };
            blades.push(FanFacet { angle_rad, inward, side: *side });
        }
        blades.sort_by(|a, b| a.angle_rad.total_cmp(&b.angle_rad).then(a.side.cmp(&b.side)));
        blades.dedup_by(|next, kept| next.angle_rad - kept.angle_rad < DOUBLED_RAD);
        Some(Fan { along, blades })
    }

    fn inward(&self, side: &TriangleSide, along: DVec3) -> Option<DVec3> {
        let corners_m = &self.triangles_m[side.triangle as usize];
        let from = usize::from(side.side);
        let opposite = corners_m[(from + 2) % 3] - corners_m[from];
        let across = self.normal(side.triangle).cross(along).try_normalize()?;
        Some(if across.dot(opposite) < 0.0 { -across } else { across })
    }

    /// Grows patches from the largest facet on: connected facets in the plane of the first.
    fn grow_patches(&mut self, near: CornerTolerance) {
        let doubled_m2 = |t: u32| {
            let [a, b, c] = self.triangles_m[t as usize];
            (b - a).cross(c - a).length()
        };
        let with_plane = |t: &u32| self.normals[*t as usize] != DVec3::ZERO;
        let mut seeds: Vec<u32> = (0..self.triangles_m.len() as u32).filter(with_plane).collect();
        seeds.sort_by(|&a, &b| doubled_m2(b).total_cmp(&doubled_m2(a)).then(a.cmp(&b)));
        let in_plane =
            |seed: u32, other: u32| self.lies_in_plane_of(seed as usize, other as usize, near.of_plane_m());
        let mut patch_of = self.edges.connected_components(seeds.iter().copied(), in_plane);
        let mut number = vec![MeshEdges::NO_SEED; patch_of.len()];
        for seed in seeds.into_iter().filter(|seed| patch_of[*seed as usize] == *seed) {
            number[seed as usize] = self.patches;
            self.patches += 1;
        }
        let is_known = |seed: &&mut u32| **seed != MeshEdges::NO_SEED;
        patch_of.iter_mut().filter(is_known).for_each(|seed| *seed = number[*seed as usize]);
        self.patch_of = patch_of;
    }

    fn lies_in_plane_of(&self, seed: usize, other: usize, tolerance_m: f64) -> bool {
        let (normal, origin) = (self.normals[seed], self.triangles_m[seed][0]);
        let is_near = |corner: &DVec3| normal.dot(*corner - origin).abs() <= tolerance_m;
        self.triangles_m[other].iter().all(is_near) && normal.dot(self.normals[other]).abs() >= FLAT_RAD.cos()
    }
}

impl Fan {
    /// Widest angle without a facet, and the blades at which it starts and ends (for a single blade: from one
    /// side to the other).
    pub(crate) fn widest_gap(&self) -> (f64, [FanFacet; 2]) {
        let next = self.blades.iter().cycle().skip(1);
        let gap = |(a, b): (&FanFacet, &FanFacet)| {
            let turn = b.angle_rad - a.angle_rad;
            (if turn > 0.0 { turn } else { turn + TAU }, [*a, *b])
        };
        let gaps = self.blades.iter().zip(next).map(gap);
        gaps.fold((0.0, [self.blades[0]; 2]), |widest, gap| if gap.0 > widest.0 { gap } else { widest })
    }
}

/// Normal as in [`crate::geometry::facet_geometry::FacetGeometry`]: a triangle whose height is rounding has
/// no plane.
fn normal_of(corners_m: &[DVec3; 3], tolerance_m: f64) -> DVec3 {
    let [a, b, c] = *corners_m;
    let longest_m = a.distance(b).max(b.distance(c)).max(c.distance(a));
    let is_thin = (b - a).cross(c - a).length() <= tolerance_m * longest_m;
    if is_thin {
        DVec3::ZERO
    } else {
        Plane::of_triangle(corners_m).map_or(DVec3::ZERO, |plane| plane.normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEAR: CornerTolerance = CornerTolerance { rounding_m: 1e-6, negligible_m: 0.0 };

    fn topology(triangles_m: &[[DVec3; 3]]) -> Topology<'_> {
        Topology::of(triangles_m, NEAR)
    }

    fn at(x: f64, y: f64, z: f64) -> DVec3 {
        DVec3::new(x, y, z)
    }

    #[test]
    fn a_t_junction_is_no_gap_in_a_patch() {
        // A triangle above the line y = 0 from 0 to 2, two below that meet it in the middle.
        let below = [
            [at(0.0, 0.0, 0.0), at(0.5, -1.0, 0.0), at(1.0, 0.0, 0.0)],
            [at(1.0, 0.0, 0.0), at(1.5, -1.0, 0.0), at(2.0, 0.0, 0.0)],
        ];
        let triangles = [[at(0.0, 0.0, 0.0), at(2.0, 0.0, 0.0), at(1.0, 1.0, 0.0)], below[0], below[1]];
        let found = topology(&triangles);
        assert_eq!(found.patches(), 1);
        let inside = found.lines().filter(|line| found.is_inside_a_patch(line)).count();
        assert_eq!((inside, found.lines().count()), (2, 8));
    }

    #[test]
    fn facets_on_each_other_are_one_sheet() {
        let t = [at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.0), at(0.0, 1.0, 0.0)];
        let turned = [t[0], t[2], t[1]];
        let triangles = [t, turned, t];
        let found = topology(&triangles);
        assert_eq!((found.patches(), found.lines().count()), (1, 3));
        for line in found.lines() {
            assert_eq!(found.fan(&line).unwrap().blades.len(), 1);
            assert!(!found.is_inside_a_patch(&line));
        }
    }

    #[test]
    fn the_widest_gap_of_a_wall_on_a_floor_is_under_the_floor() {
        let (a, b) = (at(0.0, 0.0, 0.0), at(0.0, 1.0, 0.0));
        let triangles = [[a, b, at(1.0, 0.0, 0.0)], [a, b, at(-1.0, 0.0, 0.0)], [a, b, at(0.0, 0.0, 1.0)]];
        let found = topology(&triangles);
        let line = found.lines().find(|line| line.sides.len() == 3).unwrap();
        let (gap_rad, _) = found.fan(&line).unwrap().widest_gap();
        assert!((gap_rad - std::f64::consts::PI).abs() < 1e-12);
    }
}
