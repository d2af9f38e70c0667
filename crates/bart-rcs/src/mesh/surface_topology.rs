//! Triangles by the lines that they share, and the flat patches that they make up.
//!
//! A mesh is a heap of triangles; its surface is told from positions alone: corners within a tolerance are one point, a side
//! that passes the corners of its neighbours is cut there, and what hangs together in one plane is one patch. Any mesh has
//! an answer: open, doubled, with T-junctions or with many facets at one line.

use crate::geometry::bvh::{Hierarchy, Stack};
use crate::geometry::plane::Plane;
use crate::mesh::weld::weld;
use glam::DVec3;
use std::f64::consts::TAU;
use std::ops::{ControlFlow, Range};

/// Facets nearer than this about a common side lie on each other: 1 mm over 1 m.
const DOUBLED_RAD: f64 = 1e-3;
/// Facets of one patch look the same way to this.
const FLAT_RAD: f64 = 0.5 * std::f64::consts::PI / 180.0;
const NO_PATCH: u32 = u32::MAX;

/// A side of a triangle, or the part of it between corners of its neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    /// Welded corners, ascending.
    pub(crate) ends: [u32; 2],
    pub(crate) triangle: u32,
    /// From this corner of the triangle to the next.
    pub(crate) side: u8,
}

/// The surface of a mesh.
pub(crate) struct Topology<'a> {
    triangles_m: &'a [[DVec3; 3]],
    /// Sorted.
    sides: Vec<Side>,
    /// Runs of `sides` with the same ends.
    runs: Vec<Range<usize>>,
    /// Of triangles, unit, by the winding; zero without a plane.
    normals: Vec<DVec3>,
    patch_of: Vec<u32>,
    patches: u32,
}

/// Directions of the facets at a line, square to it and away from it, by their angle about it.
pub(crate) struct Fan {
    /// Unit, along the line.
    pub(crate) along: DVec3,
    /// Facets that lie on each other are one.
    pub(crate) blades: Vec<Blade>,
}

/// A facet at a line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Blade {
    /// About the line, from the first blade on.
    pub(crate) angle_rad: f64,
    /// Unit, in the facet and away from the line.
    pub(crate) inward: DVec3,
    pub(crate) side: Side,
}

impl<'a> Topology<'a> {
    /// Of triangles in one frame; corners nearer than `tolerance_m` are one.
    pub(crate) fn of(triangles_m: &'a [[DVec3; 3]], tolerance_m: f64) -> Self {
        let names = weld(triangles_m.as_flattened(), tolerance_m);
        let normals: Vec<DVec3> = triangles_m.iter().map(|t| normal_of(t, tolerance_m)).collect();
        let whole = (0..triangles_m.len()).filter(|t| normals[*t] != DVec3::ZERO);
        let mut sides: Vec<Side> = whole.flat_map(|t| sides_of(t, &names)).collect();
        sides.sort_unstable();
        split_at_corners(&mut sides, triangles_m.as_flattened(), tolerance_m);
        let runs = runs_of(&sides);
        let patch_of = vec![NO_PATCH; triangles_m.len()];
        let mut topology = Self { triangles_m, sides, runs, normals, patch_of, patches: 0 };
        topology.grow_patches(tolerance_m);
        topology
    }

    /// Facets that share a line, for every line.
    pub(crate) fn lines(&self) -> impl Iterator<Item = &[Side]> {
        self.runs.iter().map(|run| &self.sides[run.clone()])
    }

    /// Where a line runs.
    pub(crate) fn ends_m(&self, line: &[Side]) -> [DVec3; 2] {
        line[0].ends.map(|corner| self.triangles_m.as_flattened()[corner as usize])
    }

    /// The flat patch of a triangle that has a plane.
    pub(crate) fn patch_of(&self, triangle: u32) -> u32 {
        self.patch_of[triangle as usize]
    }

    /// How many patches there are.
    pub(crate) fn patches(&self) -> usize {
        self.patches as usize
    }

    /// By the winding; zero without a plane.
    pub(crate) fn normal(&self, triangle: u32) -> DVec3 {
        self.normals[triangle as usize]
    }

    /// Whether a line lies inside one patch, with facets on both sides.
    pub(crate) fn is_inside_a_patch(&self, line: &[Side]) -> bool {
        let patch = self.patch_of(line[0].triangle);
        let same = line.iter().all(|side| self.patch_of(side.triangle) == patch);
        same && self.fan(line).is_some_and(|fan| fan.blades.len() > 1)
    }

    /// The facets about a line; `None` where its ends are one point.
    pub(crate) fn fan(&self, line: &[Side]) -> Option<Fan> {
        let [a, b] = self.ends_m(line);
        let along = (b - a).try_normalize()?;
        let first = self.inward(&line[0], along)?;
        let up = along.cross(first);
        let mut blades: Vec<Blade> = Vec::with_capacity(line.len());
        for side in line {
            let inward = self.inward(side, along)?;
            let angle = inward.dot(up).atan2(inward.dot(first));
            let angle_rad = if angle < -DOUBLED_RAD { angle + TAU } else { angle };
            blades.push(Blade { angle_rad, inward, side: *side });
        }
        blades.sort_by(|a, b| a.angle_rad.total_cmp(&b.angle_rad).then(a.side.cmp(&b.side)));
        blades.dedup_by(|next, kept| next.angle_rad - kept.angle_rad < DOUBLED_RAD);
        Some(Fan { along, blades })
    }

    fn inward(&self, side: &Side, along: DVec3) -> Option<DVec3> {
        let corners_m = &self.triangles_m[side.triangle as usize];
        let from = usize::from(side.side);
        let opposite = corners_m[(from + 2) % 3] - corners_m[from];
        let across = self.normal(side.triangle).cross(along).try_normalize()?;
        Some(if across.dot(opposite) < 0.0 { -across } else { across })
    }

    /// Patches from the largest facet on: what hangs together and lies in the plane of the first.
    fn grow_patches(&mut self, tolerance_m: f64) {
        let lines_of = self.lines_of_triangles();
        let doubled_m2 = |t: usize| {
            let [a, b, c] = self.triangles_m[t];
            (b - a).cross(c - a).length()
        };
        let mut seeds: Vec<usize> = (0..self.triangles_m.len()).filter(|t| self.normals[*t] != DVec3::ZERO).collect();
        seeds.sort_by(|&a, &b| doubled_m2(b).total_cmp(&doubled_m2(a)).then(a.cmp(&b)));
        for seed in seeds {
            if self.patch_of[seed] != NO_PATCH {
                continue;
            }
            self.patch_of[seed] = self.patches;
            let mut left = vec![seed];
            while let Some(triangle) = left.pop() {
                for &line in &lines_of[triangle] {
                    for at in self.runs[line as usize].clone() {
                        let other = self.sides[at].triangle as usize;
                        if self.patch_of[other] == NO_PATCH && self.lies_in_plane_of(seed, other, 2.0 * tolerance_m) {
                            self.patch_of[other] = self.patches;
                            left.push(other);
                        }
                    }
                }
            }
            self.patches += 1;
        }
    }

    fn lines_of_triangles(&self) -> Vec<Vec<u32>> {
        let mut lines_of = vec![Vec::new(); self.triangles_m.len()];
        for (line, run) in (0..).zip(&self.runs) {
            self.sides[run.clone()].iter().for_each(|side| lines_of[side.triangle as usize].push(line));
        }
        lines_of
    }

    fn lies_in_plane_of(&self, seed: usize, other: usize, tolerance_m: f64) -> bool {
        let (normal, origin) = (self.normals[seed], self.triangles_m[seed][0]);
        let is_near = |corner: &DVec3| normal.dot(*corner - origin).abs() <= tolerance_m;
        self.triangles_m[other].iter().all(is_near) && normal.dot(self.normals[other]).abs() >= FLAT_RAD.cos()
    }
}

impl Fan {
    /// The widest angle without a facet, and the blades that it begins and ends at (one blade: from its one side to the
    /// other).
    pub(crate) fn widest_gap(&self) -> (f64, [Blade; 2]) {
        let next = self.blades.iter().cycle().skip(1);
        let gap = |(a, b): (&Blade, &Blade)| {
            let turn = b.angle_rad - a.angle_rad;
            (if turn > 0.0 { turn } else { turn + TAU }, [*a, *b])
        };
        let gaps = self.blades.iter().zip(next).map(gap);
        gaps.fold((0.0, [self.blades[0]; 2]), |widest, gap| if gap.0 > widest.0 { gap } else { widest })
    }
}

/// The same as [`crate::bodies::world::FacetGeometry`]: a triangle whose height is rounding has no plane.
fn normal_of(corners_m: &[DVec3; 3], tolerance_m: f64) -> DVec3 {
    let [a, b, c] = *corners_m;
    let longest_m = a.distance(b).max(b.distance(c)).max(c.distance(a));
    let is_thin = (b - a).cross(c - a).length() <= tolerance_m * longest_m;
    if is_thin { DVec3::ZERO } else { Plane::of_triangle(corners_m).map_or(DVec3::ZERO, |plane| plane.normal) }
}

fn sides_of(triangle: usize, names: &[u32]) -> impl Iterator<Item = Side> {
    let of = move |side: usize| {
        let [a, b] = [side, (side + 1) % 3].map(|corner| names[3 * triangle + corner]);
        Side { ends: [a.min(b), a.max(b)], triangle: triangle as u32, side: side as u8 }
    };
    (0..3).map(of).filter(|side| side.ends[0] != side.ends[1])
}

fn runs_of(sides: &[Side]) -> Vec<Range<usize>> {
    let mut start = 0;
    let run = |run: &[Side]| {
        let range = start..start + run.len();
        start = range.end;
        range
    };
    sides.chunk_by(|a, b| a.ends == b.ends).map(run).collect()
}

/// Cuts sides that no other facet shares where corners of such sides lie on them: T-junctions.
fn split_at_corners(sides: &mut Vec<Side>, points_m: &[DVec3], tolerance_m: f64) {
    let open: Vec<usize> = runs_of(sides).into_iter().filter(|run| run.len() == 1).map(|run| run.start).collect();
    let mut corners: Vec<u32> = open.iter().flat_map(|side| sides[*side].ends).collect();
    corners.sort_unstable();
    corners.dedup();
    let hierarchy = Hierarchy::over(corners.iter().map(|c| [points_m[*c as usize]; 3]));
    let mut stack = Stack::default();
    let mut parts = Vec::new();
    for &index in &open {
        let side = sides[index];
        let mut on_side = corners_on(&side, &hierarchy, &corners, points_m, tolerance_m, &mut stack);
        if on_side.is_empty() {
            continue;
        }
        on_side.push(side.ends[1]);
        let mut from = side.ends[0];
        for to in on_side {
            let part = Side { ends: [from.min(to), from.max(to)], ..side };
            if from == side.ends[0] {
                sides[index] = part
            } else {
                parts.push(part)
            }
            from = to;
        }
    }
    sides.extend(parts);
    sides.sort_unstable();
}

/// Corners strictly between the ends of a side, in its order.
fn corners_on(
    side: &Side,
    hierarchy: &Hierarchy,
    corners: &[u32],
    points_m: &[DVec3],
    tolerance_m: f64,
    stack: &mut Stack,
) -> Vec<u32> {
    let [a, b] = side.ends.map(|end| points_m[end as usize]);
    let Some(along) = (b - a).try_normalize() else { return Vec::new() };
    let length_m = a.distance(b);
    let planes = tube_around(a, along, length_m, tolerance_m);
    let mut found: Vec<(f64, u32)> = Vec::new();
    let _ = hierarchy.inside(&planes, along, stack, |index| {
        let corner = corners[index as usize];
        let arm = points_m[corner as usize] - a;
        let at_m = arm.dot(along);
        let is_between = at_m > tolerance_m && at_m < length_m - tolerance_m && !side.ends.contains(&corner);
        if is_between && (arm - at_m * along).length() <= tolerance_m {
            found.push((at_m, corner));
        }
        ControlFlow::Continue(())
    });
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    found.dedup_by_key(|(_, corner)| *corner);
    found.into_iter().map(|(_, corner)| corner).collect()
}

/// A box about a line, as wide as the tolerance.
fn tube_around(from: DVec3, along: DVec3, length_m: f64, tolerance_m: f64) -> [Plane; 6] {
    let u = along.any_orthonormal_vector();
    let v = along.cross(u);
    let from_on = |normal: DVec3, slack_m: f64| Plane { normal, offset_m: normal.dot(from) - slack_m };
    let end = Plane { normal: -along, offset_m: -along.dot(from) - length_m - tolerance_m };
    let [a, b, c, d] = [u, -u, v, -v].map(|normal| from_on(normal, tolerance_m));
    [a, b, c, d, from_on(along, tolerance_m), end]
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE_M: f64 = 1e-6;

    fn topology(triangles_m: &[[DVec3; 3]]) -> Topology<'_> {
        Topology::of(triangles_m, TOLERANCE_M)
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
            assert_eq!(found.fan(line).unwrap().blades.len(), 1);
            assert!(!found.is_inside_a_patch(line));
        }
    }

    #[test]
    fn the_widest_gap_of_a_wall_on_a_floor_is_under_the_floor() {
        let (a, b) = (at(0.0, 0.0, 0.0), at(0.0, 1.0, 0.0));
        let triangles = [[a, b, at(1.0, 0.0, 0.0)], [a, b, at(-1.0, 0.0, 0.0)], [a, b, at(0.0, 0.0, 1.0)]];
        let found = topology(&triangles);
        let line = found.lines().find(|line| line.len() == 3).unwrap();
        let (gap_rad, _) = found.fan(line).unwrap().widest_gap();
        assert!((gap_rad - std::f64::consts::PI).abs() < 1e-12);
    }
}
