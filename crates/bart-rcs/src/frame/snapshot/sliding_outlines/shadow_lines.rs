//! Which end's shadow bounds a polygon that is lit from both ends.
//!
//! A polygon of the first order ends along the shadow of either end, whichever reaches farther into what is
//! lit. From the array's centre both are one line. It slides by s_t with the transmitter along the row, by
//! s_r with the receiver, and by the larger or the smaller of both where they are apart: a corner's phase
//! has a kink where one end passes the other.

use crate::frame::cells::corner_slide::RowSide;
use glam::DVec3;

/// Distance within which two sides lie on one line, m.
const ONE_LINE_M: f64 = 1e-7;

/// Sides of all lit polygons of a facet, each with the polygon on its left.
pub(super) struct LitSides {
    normal: DVec3,
    sides_m: Vec<[DVec3; 2]>,
}

/// A side from a corner to the next.
type Side = [DVec3; 2];

impl LitSides {
    /// None yet, of polygons that are counter-clockwise about a normal.
    pub(super) fn about(normal: DVec3) -> Self {
        Self { normal, sides_m: vec![] }
    }

    /// Adds the sides of a polygon.
    pub(super) fn add(&mut self, corners_m: &[DVec3]) {
        let next = corners_m.iter().cycle().skip(1);
        self.sides_m.extend(corners_m.iter().zip(next).map(|(from, to)| [*from, *to]));
    }

    /// Direction from the line of a side into what is lit; `None` if it is a seam, lit on both sides.
    fn towards_light(&self, side: Side) -> Option<DVec3> {
        let along = (side[1] - side[0]).normalize_or_zero();
        let off_m = |x_m: DVec3| (x_m - side[0]).reject_from_normalized(along).length();
        let on_line = self.sides_m.iter().filter(|other| other.iter().all(|end| off_m(*end) < ONE_LINE_M));
        let balance_m: f64 = on_line.map(|[from, to]| (*to - *from).dot(along)).sum();
        (balance_m.abs() > ONE_LINE_M).then(|| balance_m.signum() * self.normal.cross(along))
    }

    /// The lines that end in a corner and are no seams, each with its direction into what is lit.
    fn borders_at(&self, corner_m: DVec3) -> Vec<Border> {
        const ONE_DIRECTION: f64 = 1e-6;
        let mut borders: Vec<Border> = vec![];
        let is_here = |side: &&Side| side.iter().any(|end| end.distance(corner_m) < ONE_LINE_M);
        for side in self.sides_m.iter().filter(is_here) {
            let along = (side[1] - side[0]).normalize_or_zero();
            if borders.iter().all(|other| other.along.cross(along).length() > ONE_DIRECTION) {
                borders.extend(self.towards_light(*side).map(|light| Border { along, light }));
            }
        }
        borders
    }

    /// Slides of a corner with the transmitter and with the receiver, for each side of the row, from its
    /// slide with both ends together. Seams slide with both alike, so that pieces stay joined.
    pub(super) fn slides_of_ends(&self, corner_m: DVec3, slide: DVec3) -> [[DVec3; 2]; 2] {
        let [one, other] = match self.borders_at(corner_m)[..] {
            [one, other] => [one, other],
            _ => return [[0.5 * slide; 2]; 2],
        };
        let mut slides = [[DVec3::ZERO; 2]; 2];
        for (border, part) in
            [one, other].into_iter().zip(in_parts(slide, [one.along, other.along], self.normal))
        {
            // Where the line slides into what is lit, the farther end bounds it.
            let by_farther = border.light.dot(part) > 0.0;
            for side in RowSide::BOTH {
                let by_transmitter = by_farther == (side == RowSide::TransmitterFarther);
                slides[side as usize][usize::from(!by_transmitter)] += part;
            }
        }
        slides
    }
}

/// A line along which what is lit ends.
#[derive(Debug, Clone, Copy)]
struct Border {
    along: DVec3,
    /// Direction into what is lit.
    light: DVec3,
}

/// The parts of a corner's slide by the line of the side before it, and by that of the side after it: as one
/// of both slides, the corner stays on the other.
fn in_parts(slide: DVec3, [before, after]: [DVec3; 2], normal: DVec3) -> [DVec3; 2] {
    let across = before.cross(after).dot(normal);
    if across.abs() < 1e-9 {
        return [0.5 * slide; 2];
    }
    let by_before = slide.cross(before).dot(normal) / -across;
    let by_after = slide.cross(after).dot(normal) / across;
    [by_before * after, by_after * before]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slide_is_the_sum_of_its_parts_along_both_sides() {
        let (before, after) = (DVec3::new(0.6, 0.8, 0.0), DVec3::new(-0.8, 0.6, 0.0));
        let slide = DVec3::new(0.3, -0.2, 0.0);
        let parts = in_parts(slide, [before, after], DVec3::Z);
        assert!((parts[0] + parts[1] - slide).length() < 1e-15);
        assert!(parts[0].cross(after).length() < 1e-15 && parts[1].cross(before).length() < 1e-15);
    }

    /// A square lit but for its lower left quarter, in two pieces with a seam along the shadow's upper line.
    #[test]
    fn the_shadow_that_reaches_farther_bounds_what_is_lit_and_a_seam_is_no_border() {
        let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let upper = [corner(0.0, 1.0), corner(2.0, 1.0), corner(2.0, 2.0), corner(0.0, 2.0)];
        let right = [corner(1.0, 0.0), corner(2.0, 0.0), corner(2.0, 1.0), corner(1.0, 1.0)];
        let lit_of = |polygons: [&[DVec3]; 2]| {
            let mut lit = LitSides::about(DVec3::Z);
            polygons.into_iter().for_each(|corners_m| lit.add(corners_m));
            lit
        };
        let lit = lit_of([&upper, &right]);
        assert_eq!(lit.towards_light([corner(1.0, 1.0), corner(1.0, 0.0)]), Some(DVec3::X));
        assert_eq!(lit.towards_light([corner(0.0, 1.0), corner(2.0, 1.0)]), Some(DVec3::Y));
        let whole = lit_of([&upper, &[upper[1], upper[0], right[0]]]);
        assert_eq!(whole.towards_light([upper[0], upper[1]]), None);
        // The shadow's corner slides up and to the right with both ends: up by the upper line, which is lit
        // above, to the right by the right line.
        let [farther, nearer] = lit.slides_of_ends(corner(1.0, 1.0), corner(0.3, 0.2));
        assert_eq!((farther, nearer), ([corner(0.3, 0.2), DVec3::ZERO], [DVec3::ZERO, corner(0.3, 0.2)]));
        let [farther, nearer] = lit.slides_of_ends(corner(1.0, 1.0), corner(0.3, -0.2));
        assert_eq!(farther, [corner(0.3, 0.0), corner(0.0, -0.2)]);
        assert_eq!(nearer, [corner(0.0, -0.2), corner(0.3, 0.0)]);
        // The seam on the shadow's line slides with the line.
        let [farther, nearer] = lit.slides_of_ends(corner(2.0, 1.0), DVec3::Y);
        assert_eq!((farther, nearer), ([DVec3::Y, DVec3::ZERO], [DVec3::ZERO, DVec3::Y]));
    }
}
