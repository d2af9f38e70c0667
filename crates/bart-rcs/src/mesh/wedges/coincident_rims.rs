//! Open edges that run side by side: the rims of a double skin, closer than a wave can resolve.
//!
//! The fringe currents of two half-planes a fraction of a wavelength apart are not the sum of those of each
//! alone: together they act as one half-plane, the limit of zero distance. Which of the edges carries the
//! current where both are lit depends on the antenna's position, and is decided where lit edges are found.

use crate::geometry::bvh::{Hierarchy, Stack};
use crate::geometry::plane::Plane;
use crate::mesh::wedges::body_edges::BodyEdge;
use glam::DVec3;
use std::ops::ControlFlow;

/// Minimum cosine between the normals, and between the directions, of open edges on one line: 2.6°.
const ALIKE_COSINE: f64 = 0.999;

/// First edge of the line that each edge belongs to: for most its own index.
pub(crate) fn lines(edges: &[BodyEdge], near_m: f64) -> Vec<u32> {
    let open: Vec<u32> =
        (0..edges.len() as u32).filter(|edge| edges[*edge as usize].wedge.exterior == 2.0).collect();
    let ends_m = |edge: u32| edges[edge as usize].ends_m;
    let hierarchy = Hierarchy::over(open.iter().map(|edge| {
        let [from, to] = ends_m(*edge);
        [from, to, to]
    }));
    let mut stack = Stack::default();
    let mut first: Vec<u32> = (0..edges.len() as u32).collect();
    for &edge in &open {
        let [from, to] = ends_m(edge);
        let along = edges[edge as usize].wedge.along;
        let planes = box_around([from, to], near_m);
        let _ = hierarchy.inside(&planes, None, along, &mut stack, |index| {
            let other = open[index as usize];
            if other < edge && run_side_by_side([&edges[other as usize], &edges[edge as usize]], near_m) {
                unite(&mut first, other, edge);
            }
            ControlFlow::Continue(())
        });
    }
    (0..edges.len() as u32).map(|edge| root(&first, edge)).collect()
}

/// Whether two open edges are rims of half-planes that almost coincide, over some length of both.
fn run_side_by_side([one, other]: [&BodyEdge; 2], near_m: f64) -> bool {
    let (along, inward) = (one.wedge.along, one.wedge.inward[0]);
    let is_alike = along.dot(other.wedge.along) > ALIKE_COSINE
        && inward.dot(other.wedge.inward[0]) > ALIKE_COSINE
        && one.patches[0] != other.patches[0];
    let place = |x: DVec3| (x - one.ends_m[0]).dot(along);
    let [from_m, to_m] = [place(other.ends_m[0]), place(other.ends_m[1])];
    let span_m = [from_m.max(0.0), to_m.min(place(one.ends_m[1]))];
    let gap_m = |at_m: f64| {
        let x = other.ends_m[0].lerp(other.ends_m[1], (at_m - from_m) / (to_m - from_m));
        x.distance(one.ends_m[0] + at_m * along)
    };
    is_alike && span_m[0] < span_m[1] && span_m.into_iter().all(|at_m| gap_m(at_m) < near_m)
}

fn unite(first: &mut [u32], one: u32, other: u32) {
    let (one, other) = (root(first, one), root(first, other));
    first[one.max(other) as usize] = one.min(other);
}

fn root(first: &[u32], mut edge: u32) -> u32 {
    while first[edge as usize] != edge {
        edge = first[edge as usize];
    }
    edge
}

/// Planes of the axis-aligned box around two points, widened by a distance.
fn box_around([a, b]: [DVec3; 2], wider_m: f64) -> [Plane; 6] {
    let (low, high) = (a.min(b) - wider_m, a.max(b) + wider_m);
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let above = axes.map(|normal| Plane { normal, offset_m: normal.dot(low) });
    let below = axes.map(|normal| Plane { normal: -normal, offset_m: -normal.dot(high) });
    let ([a, b, c], [d, e, f]) = (above, below);
    [a, b, c, d, e, f]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::wedges::body_edges::body_edges;

    fn sheet(x: f64, width: f64) -> [[DVec3; 3]; 2] {
        let at = |y: f64, z: f64| DVec3::new(x, y, z);
        let (a, b, c, d) = (at(0.0, 0.0), at(width, 0.0), at(width, 0.2), at(0.0, 0.2));
        [[a, b, c], [a, c, d]]
    }

    fn lines_of(sheets: &[[[DVec3; 3]; 2]], near_m: f64) -> usize {
        let edges = body_edges(sheets.as_flattened(), &[], 0.0).edges;
        let mut lines = lines(&edges, near_m);
        lines.sort_unstable();
        lines.dedup();
        lines.len()
    }

    #[test]
    fn rims_of_a_double_skin_are_one_line_each_and_rims_farther_apart_are_two() {
        let double = [sheet(0.0, 0.3), sheet(-1e-3, 0.3)];
        assert_eq!([lines_of(&double, 2e-3), lines_of(&double, 5e-4)], [4, 8]);
        // With a wider one behind, one side alone runs elsewhere.
        assert_eq!(lines_of(&[sheet(0.0, 0.3), sheet(-1e-3, 0.35)], 2e-3), 5);
        assert_eq!(lines_of(&[sheet(0.0, 0.3), sheet(-1e-3, 0.3), sheet(-2e-3, 0.3)], 1.5e-3), 4);
    }
}
