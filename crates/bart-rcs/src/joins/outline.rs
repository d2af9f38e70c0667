//! The outline of what two beams light together, and how much of it is the own edge of the facet.
//!
//! Lines that cut out shadows go on between lit pieces: what ends there is known once all pieces of a node are
//! together ([`crate::joins::shadow_sides`]).

use crate::geometry::border::{Border, BorderLine};
use glam::DVec2;

/// Outline of a polygon, or of many pieces together, m; edges that end facet and beam alike are left out.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Outline {
    /// Length along the facet's own edges and shadow lines on it.
    pub(crate) own_m: f64,
    /// Length along what mirrors before cut.
    pub(crate) cut_m: f64,
}

/// A convex polygon in a plane and what ends it from each corner to the next.
pub(crate) struct Bordered<'a> {
    pub(crate) corners_m: &'a [DVec2],
    pub(crate) borders: &'a [BorderLine],
}

impl Outline {
    /// The outline of the overlap of two polygons, less its sides along lines that cut out shadows: these are
    /// handed to `shadow_side` by their place.
    ///
    /// Edges nearer to each other than `tolerance_m` are one line.
    pub(crate) fn of_overlap(
        overlap_m: &[DVec2],
        polygons: [&Bordered<'_>; 2],
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

    /// Share of the own edges in the outline, between 0 and 1.
    pub(crate) fn own_share(self) -> f64 {
        if self.own_m > 0.0 { self.own_m / (self.own_m + self.cut_m) } else { 0.0 }
    }
}

impl Bordered<'_> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::beam::{BeamTree, TraceSettings};
    use crate::bodies::world::World;
    use crate::geometry::antenna::Antenna;
    use crate::joins::shadow_sides::{ShadowSide, of_shadow_sides};
    use artifact::scene::Mesh;
    use artifact::settings::Sides;
    use glam::DVec3;

    /// Squares of this side about (x, y) at height z, seen from above.
    fn outline_of_lowest(squares: &[(f64, [f64; 3])]) -> Outline {
        let mut mesh = Mesh::default();
        for (side, [x, y, z]) in squares {
            let first = mesh.vertices_m.len() as u32;
            let corner = |i: f64, j: f64| [x + 0.5 * side * i, y + 0.5 * side * j, *z];
            mesh.vertices_m.extend([
                corner(-1.0, -1.0),
                corner(1.0, -1.0),
                corner(1.0, 1.0),
                corner(-1.0, 1.0),
            ]);
            mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
        let world = World::of_mesh(&mesh).unwrap();
        let settings =
            TraceSettings { max_order: 1, sides: Sides::Two, least_area_m2: 0.0, least_mirror_area_m2: 0.0 };
        let tree = BeamTree::trace(&world, Antenna::Direction(DVec3::Z), &settings).unwrap();
        let (mut all, mut sides) = (Outline::default(), Vec::new());
        for beam in tree.beams.iter().filter(|beam| beam.facet < 2) {
            let corners = tree.polygon(beam);
            let corners_m: Vec<DVec2> = corners.iter().map(|c| c.truncate()).collect();
            let bordered = Bordered { corners_m: &corners_m, borders: tree.borders(beam) };
            all.add(Outline::of_overlap(&corners_m, [&bordered, &bordered], 1e-9, |i, border| {
                sides.push(ShadowSide { border, ends_m: [corners[i], corners[(i + 1) % corners.len()]] });
            }));
        }
        all.add(of_shadow_sides(&mut sides));
        all
    }

    #[test]
    fn a_square_has_its_rim_and_not_its_diagonal() {
        let outline = outline_of_lowest(&[(2.0, [0.0; 3])]);
        assert!((outline.own_m - 8.0).abs() < 1e-12 && outline.cut_m == 0.0, "{outline:?}");
    }

    #[test]
    fn seams_between_pieces_around_a_shadow_cancel() {
        // A shadow of 0.6 in the middle, and one that bites 0.1 × 0.4 out of the rim: 8 + 2.4 + 0.2.
        let outline = outline_of_lowest(&[(2.0, [0.0; 3]), (0.6, [0.1, 0.2, 0.3]), (0.4, [-1.1, -0.4, 0.2])]);
        assert!((outline.own_m - 10.6).abs() < 1e-9 && outline.cut_m == 0.0, "{outline:?}");
    }
}
