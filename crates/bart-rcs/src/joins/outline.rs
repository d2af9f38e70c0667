//! Outline of the overlap of two beams, and the part of it that is the facet's own edge.
//!
//! Lines that cut out shadows continue between lit pieces: what ends there is known only once all pieces of a
//! node are collected (`shadow_sides.rs`, whose tests cover whole outlines).

use crate::geometry::border::{Border, BorderLine};
use glam::DVec2;

/// Outline of a polygon, or of many pieces together, m; edges at which facet and beam both end are left out.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Outline {
    /// Length along the facet's own edges and shadow lines on it.
    pub(crate) own_m: f64,
    /// Length along cuts by preceding mirrors.
    pub(crate) cut_m: f64,
}

/// A convex polygon in a plane, with its borders from each corner to the next.
pub(crate) struct BorderedPolygon<'a> {
    pub(crate) corners_m: &'a [DVec2],
    pub(crate) borders: &'a [BorderLine],
}

impl Outline {
    /// Outline of the overlap of two polygons, without sides along lines that cut out shadows: these are
    /// passed to `shadow_side` by index.
    ///
    /// Edges closer to each other than `tolerance_m` are one line.
    pub(crate) fn of_overlap(
        overlap_m: &[DVec2],
        polygons: [&BorderedPolygon<'_>; 2],
        tolerance_m: f64,
        mut shadow_side: impl FnMut(usize, BorderLine),
    ) -> Self {
        let mut outline = Self::default();
        for (i, &from) in overlap_m.iter().enumerate() {
            let to = overlap_m[(i + 1) % overlap_m.len()];
            let borders =
                polygons.into_iter().filter_map(|polygon| polygon.border_along(from, to, tolerance_m));
            let Some(at) = borders.reduce(BorderLine::and) else { continue };
            match at.border {
                Border::Own => outline.own_m += from.distance(to),
                Border::Mirror => outline.cut_m += from.distance(to),
                Border::Shadow | Border::MirrorShadow => shadow_side(i, at),
                Border::Tied | Border::Inner => {}
            }
        }
        outline
    }

    pub(crate) fn add(&mut self, other: Self) {
        self.own_m += other.own_m;
        self.cut_m += other.cut_m;
    }

    /// Share of own edges in the outline, between 0 and 1.
    pub(crate) fn own_share(self) -> f64 {
        if self.own_m > 0.0 { self.own_m / (self.own_m + self.cut_m) } else { 0.0 }
    }
}

impl BorderedPolygon<'_> {
    /// Border of the polygon along a line that may lie on one of its edges; several edges of a polygon can
    /// lie in a line.
    fn border_along(&self, from: DVec2, to: DVec2, tolerance_m: f64) -> Option<BorderLine> {
        let n = self.corners_m.len();
        let on_edge = |&i: &usize| {
            let (corner, edge) = (self.corners_m[i], self.corners_m[(i + 1) % n] - self.corners_m[i]);
            let near = |x: DVec2| edge.perp_dot(x - corner).abs() <= tolerance_m * edge.length();
            let along = edge.dot(0.5 * (from + to) - corner);
            near(from) && near(to) && (0.0..edge.length_squared()).contains(&along)
        };
        (0..n).filter(on_edge).map(|i| self.borders[i]).reduce(BorderLine::and)
    }
}
