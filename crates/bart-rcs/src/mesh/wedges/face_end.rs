//! Extent of a face: from a point of an edge along its plane to where its currents end.

use crate::mesh::wedges::body_edges::PatchEnd;
use glam::{DVec2, DVec3};

/// Ends of a flat patch in the coordinates of one of its edges: x perpendicular to the edge into the patch, z
/// along it.
pub(crate) struct FaceEnds {
    ends: Vec<([DVec2; 2], Option<u32>)>,
}

/// Intersection of a ray along a face with its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FaceExit {
    /// Distance along the ray.
    pub(crate) way_m: f64,
    /// Edge there; `None` at a wall.
    pub(crate) edge: Option<u32>,
    /// Index of the end.
    pub(crate) end: usize,
}

impl FaceEnds {
    /// Ends seen from the edge that starts at `from_m` and runs along `along`; its own line is no end.
    pub(crate) fn seen_from(from_m: DVec3, along: DVec3, inward: DVec3, ends: &[PatchEnd]) -> Self {
        let place = |x: &DVec3| DVec2::new((*x - from_m).dot(inward), (*x - from_m).dot(along));
        let extent_m = ends.iter().flat_map(|end| end.ends_m).map(|x| x.distance(from_m)).fold(0.0, f64::max);
        // Corners on one line differ by single precision (body_edges::tolerance_m).
        let own_m = 16.0 * f64::from(f32::EPSILON) * extent_m;
        let placed = ends.iter().map(|end| ([place(&end.ends_m[0]), place(&end.ends_m[1])], end.edge));
        Self { ends: placed.filter(|(end, _)| end[0].x > own_m || end[1].x > own_m).collect() }
    }

    /// Nearest end from (0, `at_m`) along the unit vector `direction` (x > 0).
    pub(crate) fn nearest(&self, at_m: f64, direction: DVec2) -> Option<FaceExit> {
        let start = DVec2::new(0.0, at_m);
        let is_met = |(corners, _): &([DVec2; 2], Option<u32>)| {
            let [p, q] = corners.map(|x| direction.perp_dot(x - start) < 0.0);
            p != q
        };
        let met = (0..self.ends.len()).filter(|end| is_met(&self.ends[*end]));
        let ahead = met.map(|end| self.on_line(end, at_m, direction)).filter(|met| met.way_m > 0.0);
        ahead.reduce(|a, b| if b.way_m < a.way_m { b } else { a })
    }

    /// Intersection of a ray from (0, `at_m`) with the line of one end, possibly beyond its corners; the
    /// start itself if the line lies behind it.
    pub(crate) fn on_line(&self, end: usize, at_m: f64, direction: DVec2) -> FaceExit {
        let start = DVec2::new(0.0, at_m);
        let ([p, q], edge) = self.ends[end];
        let [across_p, across_q] = [p, q].map(|x| direction.perp_dot(x - start));
        let way_m = direction.dot(p.lerp(q, across_p / (across_p - across_q)) - start);
        FaceExit { way_m: way_m.max(0.0), edge, end }
    }

    /// Positions along the edge where rays in `direction` change from one end to another: the ends' corners,
    /// within `span_m`.
    pub(crate) fn changes_m(&self, direction: DVec2, span_m: [f64; 2]) -> Vec<f64> {
        let corners = self.ends.iter().flat_map(|(end, _)| end).filter(|corner| corner.x > 0.0);
        let mut changes: Vec<f64> =
            corners.map(|corner| corner.y - corner.x * direction.y / direction.x).collect();
        changes.retain(|at| *at > span_m[0] && *at < span_m[1]);
        changes.sort_by(f64::total_cmp);
        changes.dedup();
        changes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_ends_at_the_nearest_end_that_it_meets() {
        let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let square = [corner(0.0, 0.0), corner(0.0, 2.0), corner(3.0, 2.0), corner(3.0, 0.0)];
        let end = |i: usize| PatchEnd { ends_m: [square[i], square[(i + 1) % 4]], edge: Some(i as u32) };
        let ends: Vec<PatchEnd> = (0..4).map(end).collect();
        let seen = FaceEnds::seen_from(DVec3::ZERO, DVec3::Y, DVec3::X, &ends);
        assert_eq!(seen.nearest(0.5, DVec2::X), Some(FaceExit { way_m: 3.0, edge: Some(2), end: 1 }));
        let slant = DVec2::new(0.6, 0.8);
        assert!((seen.nearest(0.4, slant).unwrap().way_m - 2.0).abs() < 1e-14, "to the upper side");
        assert!((seen.nearest(-3.9, slant).unwrap().way_m - 4.875).abs() < 1e-14, "through the lower side");
        let past = seen.on_line(1, 1.9, slant);
        assert!((past.way_m - 5.0).abs() < 1e-14, "beyond the corner, on the far side's line");
        assert_eq!(seen.on_line(2, 1.9, slant).way_m, 0.0, "the lower side lies behind");
        let changes = seen.changes_m(DVec2::new(0.8, 0.6), [0.0, 2.0]);
        assert!(changes.is_empty() || changes.iter().all(|c| *c > 0.0));
        assert_eq!(FaceEnds { ends: Vec::new() }.nearest(0.0, DVec2::X), None);
    }
}
