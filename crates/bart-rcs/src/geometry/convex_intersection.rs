//! Intersection of convex polygons in a plane (Sutherland, Hodgman 1974).

use glam::DVec2;

/// Part of `subject` inside `window`, both convex and counter-clockwise; empty if they do not overlap.
pub(crate) fn intersection(subject: &[DVec2], window: &[DVec2]) -> Vec<DVec2> {
    let mut part = subject.to_vec();
    let mut cut = Vec::new();
    for (i, &from) in window.iter().enumerate() {
        let edge = window[(i + 1) % window.len()] - from;
        if part.iter().all(|&corner| edge.perp_dot(corner - from) >= 0.0) {
            continue;
        }
        cut_left_of(&part, from, edge, &mut cut);
        std::mem::swap(&mut part, &mut cut);
        if part.len() < 3 {
            part.clear();
            break;
        }
    }
    part
}

/// Part of a convex polygon to the left of the line from `from` along `edge`, the line included.
pub(crate) fn left_of(corners: &[DVec2], from: DVec2, edge: DVec2) -> Vec<DVec2> {
    let mut part = Vec::with_capacity(corners.len() + 1);
    cut_left_of(corners, from, edge, &mut part);
    part
}

/// Stores the part to the left of a line, as in [`left_of`], in a list that is cleared first.
fn cut_left_of(corners: &[DVec2], from: DVec2, edge: DVec2, part: &mut Vec<DVec2>) {
    let height = |c: DVec2| edge.perp_dot(c - from);
    part.clear();
    for (i, &corner) in corners.iter().enumerate() {
        let next = corners[(i + 1) % corners.len()];
        let (here, there) = (height(corner), height(next));
        if here >= 0.0 {
            part.push(corner);
        }
        if (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0) {
            part.push(corner.lerp(next, here / (here - there)));
        }
    }
}

/// Smallest box around a polygon: lowest and highest coordinates.
pub(crate) fn bounds(corners: &[DVec2]) -> [DVec2; 2] {
    let start = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    corners.iter().fold(start, |[low, high], c| [low.min(*c), high.max(*c)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::plane_frame::area_m2;

    const SQUARE: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];

    #[test]
    fn a_polygon_meets_itself_in_itself() {
        assert_eq!(intersection(&SQUARE, &SQUARE), SQUARE);
    }

    #[test]
    fn a_shifted_square_leaves_the_overlap_and_a_distant_or_touching_one_nothing() {
        let shifted = |by: DVec2| SQUARE.map(|c| c + by);
        assert!((area_m2(&intersection(&SQUARE, &shifted(DVec2::new(0.25, 0.5)))) - 0.375).abs() < 1e-15);
        assert!(area_m2(&intersection(&SQUARE, &shifted(DVec2::X))) == 0.0);
        assert!(intersection(&SQUARE, &shifted(2.0 * DVec2::X)).is_empty());
    }
}
