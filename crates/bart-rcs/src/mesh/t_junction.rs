//! T-junctions: a side that passes corners of its neighbours is cut there.

use crate::geometry::bvh::{Hierarchy, Stack};
use crate::geometry::plane::Plane;
use crate::mesh::mesh_edges::SidePart;
use glam::DVec3;
use std::ops::ControlFlow;

/// Distances within which corners lie on a side.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CornerTolerance {
    /// Distance of rounding in the file, within which any corner lies on a side.
    pub(crate) rounding_m: f64,
    /// Distance negligible for a wave, within which, and a hundredth of the side's length, corners also lie
    /// on it: files with rounded coordinates have them beside it.
    pub(crate) negligible_m: f64,
}

impl CornerTolerance {
    /// Distance within which corners lie on a side of this length.
    fn of_side_m(self, length_m: f64) -> f64 {
        const OF_LENGTH: f64 = 0.01;
        self.rounding_m.max(self.negligible_m.min(OF_LENGTH * length_m))
    }

    /// Distance within which corners lie in a plane.
    pub(crate) fn of_plane_m(self) -> f64 {
        2.0 * self.rounding_m.max(self.negligible_m)
    }
}

/// Cuts unshared sides where corners of other unshared sides lie on them: T-junctions.
///
/// `points_m` are the points of the places named by the sides.
pub(crate) fn cut_at_corners(sides: &mut Vec<SidePart>, points_m: &[DVec3], near: CornerTolerance) {
    sides.sort_unstable();
    let open = alone(sides);
    let mut corners: Vec<u32> = open.iter().flat_map(|side| sides[*side].ends).collect();
    corners.sort_unstable();
    corners.dedup();
    let hierarchy = Hierarchy::over(corners.iter().map(|c| [points_m[*c as usize]; 3]));
    let mut stack = Stack::default();
    let mut parts = Vec::new();
    for &index in &open {
        let side = sides[index];
        let mut on_side = corners_on(&side, &hierarchy, &corners, points_m, near, &mut stack);
        if on_side.is_empty() {
            continue;
        }
        on_side.push(side.ends[1]);
        let mut from = side.ends[0];
        for to in on_side {
            let part = SidePart { ends: [from.min(to), from.max(to)], ..side };
            if from == side.ends[0] {
                sides[index] = part
            } else {
                parts.push(part)
            }
            from = to;
        }
    }
    sides.extend(parts);
}

/// Indices of sorted sides whose ends no other side has.
fn alone(sides: &[SidePart]) -> Vec<usize> {
    let differs =
        |a: usize, b: usize| sides.get(a).map(|side| side.ends) != sides.get(b).map(|side| side.ends);
    (0..sides.len()).filter(|&i| (i == 0 || differs(i - 1, i)) && differs(i, i + 1)).collect()
}

/// Corners strictly between the ends of a side, in its order.
fn corners_on(
    side: &SidePart,
    hierarchy: &Hierarchy,
    corners: &[u32],
    points_m: &[DVec3],
    near: CornerTolerance,
    stack: &mut Stack,
) -> Vec<u32> {
    let [a, b] = side.ends.map(|end| points_m[end as usize]);
    let Some(along) = (b - a).try_normalize() else { return Vec::new() };
    let length_m = a.distance(b);
    let tolerance_m = near.of_side_m(length_m);
    let planes = tube_around(a, along, length_m, tolerance_m);
    let mut found: Vec<(f64, u32)> = Vec::new();
    let _ = hierarchy.inside(&planes, None, along, stack, |index| {
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

/// A box around a line, as wide as the tolerance.
fn tube_around(from: DVec3, along: DVec3, length_m: f64, tolerance_m: f64) -> [Plane; 6] {
    let u = along.any_orthonormal_vector();
    let v = along.cross(u);
    let from_on = |normal: DVec3, slack_m: f64| Plane { normal, offset_m: normal.dot(from) - slack_m };
    let end = Plane { normal: -along, offset_m: -along.dot(from) - length_m - tolerance_m };
    let [a, b, c, d] = [u, -u, v, -v].map(|normal| from_on(normal, tolerance_m));
    [a, b, c, d, from_on(along, tolerance_m), end]
}
