//! Borders along lines that cut out shadows, over all pieces of a node.
//!
//! Such a line continues between lit pieces. A stretch of it with a piece on both sides is a seam, and one
//! with a piece on one side only is a border, whatever happened to the other: hidden by what ends there, or
//! too small to be kept. The outline is thus that of the existing pieces.

use crate::geometry::border::{Border, BorderLine};
use crate::joins::outline::Outline;
use glam::DVec3;

/// A polygon's side along a line that cuts out a shadow, in the polygon's winding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ShadowSide {
    pub(crate) border: BorderLine,
    pub(crate) ends_m: [DVec3; 2],
}

/// Outline of all pieces' sides along lines that cut out shadows; sorts them by line.
pub(crate) fn of_shadow_sides(sides: &mut [ShadowSide]) -> Outline {
    sides.sort_by_key(|side| side.border.line());
    let lines = sides.chunk_by(|a, b| a.border.line() == b.border.line());
    let mut outline = Outline::default();
    lines.for_each(|line| outline.add(of_line(line)));
    outline
}

impl ShadowSide {
    fn length_m(&self) -> f64 {
        self.ends_m[0].distance(self.ends_m[1])
    }

    /// Adds a length to the kind of border that it is.
    fn end(&self, length_m: f64, outline: &mut Outline) {
        match self.border.border {
            Border::Shadow => outline.own_m += length_m,
            _ => outline.cut_m += length_m,
        }
    }
}

/// Outline along one line. Pieces on its two sides run along it in opposite senses; a surplus in one sense is
/// border.
fn of_line(sides: &[ShadowSide]) -> Outline {
    let mut outline = Outline::default();
    if let [side] = sides {
        side.end(side.length_m(), &mut outline);
        return outline;
    }
    let Some(longest) = sides.iter().max_by(|a, b| a.length_m().total_cmp(&b.length_m())) else {
        return outline;
    };
    let [from_m, to_m] = longest.ends_m;
    let along = (to_m - from_m).normalize_or_zero();
    let places_m: Vec<[f64; 2]> =
        sides.iter().map(|side| side.ends_m.map(|end_m| along.dot(end_m - from_m))).collect();
    let mut marks_m: Vec<f64> = places_m.iter().copied().flatten().collect();
    marks_m.sort_unstable_by(f64::total_cmp);
    let way = |[from, to]: &[f64; 2]| if from < to { 1 } else { -1 };
    for marks_m in marks_m.windows(2) {
        let (low_m, high_m) = (marks_m[0], marks_m[1]);
        let is_there = |[from, to]: &[f64; 2]| from.min(*to) <= low_m && high_m <= from.max(*to);
        let there = || sides.iter().zip(&places_m).filter(|(_, place)| is_there(place));
        let balance = there().map(|(_, place)| way(place)).sum::<i32>();
        let left = || there().filter(|(_, place)| way(place) == balance.signum());
        let length_m = f64::from(balance.abs()) * (high_m - low_m) / left().count().max(1) as f64;
        left().for_each(|(side, _)| side.end(length_m, &mut outline));
    }
    outline
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::beam::{BeamTree, TraceSettings};
    use crate::bodies::world::World;
    use crate::geometry::antenna::Antenna;
    use crate::geometry::plane::Plane;
    use crate::joins::outline::BorderedPolygon;
    use artifact::scene::Mesh;
    use artifact::settings::Sides;
    use glam::DVec2;

    /// A side of y = 1 from one x to another, of a polygon on its left as seen from above.
    fn side(border: Border, [from, to]: [f64; 2]) -> ShadowSide {
        let border = BorderLine::from(border).cut_by(&Plane { normal: DVec3::Y, offset_m: 1.0 });
        ShadowSide { border, ends_m: [from, to].map(|x| DVec3::new(x, 1.0, 0.0)) }
    }

    fn assert_ends(sides: &[ShadowSide], asked_m: [f64; 2]) {
        let Outline { own_m, cut_m } = of_shadow_sides(&mut sides.to_vec());
        assert!((own_m - asked_m[0]).abs() < 1e-12 && (cut_m - asked_m[1]).abs() < 1e-12, "{own_m} {cut_m}");
    }

    #[test]
    fn a_stretch_with_a_piece_on_one_side_alone_is_a_border() {
        let above = |ends_m| side(Border::Shadow, ends_m);
        assert_ends(&[above([0.0, 3.0])], [3.0, 0.0]);
        assert_ends(&[above([0.0, 3.0]), above([3.0, 0.0])], [0.0, 0.0]);
        // Two pieces above, and one below that extends farther: it ends between them and beyond.
        assert_ends(&[above([0.0, 1.0]), above([1.5, 2.0]), above([3.0, 0.0])], [1.5, 0.0]);
        // One above that extends farther ends in the other sense.
        assert_ends(&[above([0.0, 3.0]), above([2.0, 0.0])], [1.0, 0.0]);
        assert_ends(&[side(Border::MirrorShadow, [0.0, 3.0]), above([1.0, 0.0])], [0.0, 2.0]);
    }

    #[test]
    fn pieces_that_lie_on_each_other_count_each() {
        let above = |ends_m| side(Border::Shadow, ends_m);
        assert_ends(&[above([0.0, 3.0]), above([0.0, 3.0])], [6.0, 0.0]);
        assert_ends(&[above([0.0, 3.0]), above([0.0, 3.0]), above([2.0, 0.0])], [4.0, 0.0]);
    }

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
            let bordered = BorderedPolygon { corners_m: &corners_m, borders: tree.borders(beam) };
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
        // A shadow of 0.6 in the middle, and one that cuts 0.1 × 0.4 out of the rim: 8 + 2.4 + 0.2.
        let outline = outline_of_lowest(&[(2.0, [0.0; 3]), (0.6, [0.1, 0.2, 0.3]), (0.4, [-1.1, -0.4, 0.2])]);
        assert!((outline.own_m - 10.6).abs() < 1e-9 && outline.cut_m == 0.0, "{outline:?}");
    }
}
