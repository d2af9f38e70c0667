//! Clipping of convex polygons by planes, in double precision.
//!
//! Every edge of a polygon stores the plane that made it. Later decisions use these original planes, never
//! planes through constructed corners: an edge of a nanometre still has the exact direction of its origin.

use crate::geometry::border::BorderLine;
use crate::geometry::plane::Plane;
use glam::DVec3;
use std::ops::Range;

/// A corner and the edge that leaves it, counter-clockwise about the lit normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Corner {
    /// Position, world metres.
    pub(crate) point_m: DVec3,
    /// Plane through the antenna and the edge from here to the next corner, positive on the polygon's side.
    pub(crate) edge: Plane,
    /// Border of the polygon along that edge.
    pub(crate) border: BorderLine,
}

/// Parts of a polygon on both sides of a plane.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Split {
    /// The whole polygon is on the positive side, or on the plane.
    Inside,
    /// No part of the polygon is on the positive side.
    Outside,
    /// Both parts were appended.
    Cut {
        /// Corners of the part on the positive side.
        inside: Range<usize>,
        /// Corners of the rest.
        outside: Range<usize>,
    },
}

/// Splits the convex polygon `corners[polygon]` and appends the parts to `corners`; the new edges are a
/// `border` of both. Corners nearer to the plane than `tolerance_m` count as on it and belong to both parts,
/// so that no part is thinner than that.
pub(crate) fn split(
    corners: &mut Vec<Corner>,
    polygon: Range<usize>,
    plane: &Plane,
    border: impl Into<BorderLine>,
    tolerance_m: f64,
    distances_m: &mut Vec<f64>,
) -> Split {
    distances_m.clear();
    distances_m
        .extend(corners[polygon.clone()].iter().map(|c| snapped(plane.distance_m(c.point_m), tolerance_m)));
    if !distances_m.iter().any(|&d| d > 0.0) {
        return Split::Outside;
    }
    if !distances_m.iter().any(|&d| d < 0.0) {
        return Split::Inside;
    }
    let (start, border) = (corners.len(), border.into().cut_by(plane));
    append_part(corners, polygon.clone(), (plane, border), distances_m);
    let middle = corners.len();
    distances_m.iter_mut().for_each(|d| *d = -*d);
    append_part(corners, polygon, (&-*plane, border), distances_m);
    Split::Cut { inside: start..middle, outside: middle..corners.len() }
}

/// Twice the vector area of a polygon, by Newell's sum about its first corner.
pub(crate) fn doubled_area(points_m: impl IntoIterator<Item = DVec3>) -> DVec3 {
    let mut points = points_m.into_iter();
    let (Some(first), Some(second)) = (points.next(), points.next()) else { return DVec3::ZERO };
    let (mut sum, mut last) = (DVec3::ZERO, second - first);
    for point in points {
        let arm = point - first;
        sum += last.cross(arm);
        last = arm;
    }
    sum
}

/// Length of a polygon's outline, m.
pub(crate) fn perimeter_m(corners: &[Corner]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a.point_m.distance(b.point_m)).sum()
}

fn snapped(distance_m: f64, tolerance_m: f64) -> f64 {
    if distance_m.abs() <= tolerance_m { 0.0 } else { distance_m }
}

/// Sutherland–Hodgman clip of one convex polygon: keeps what is not on the negative side.
fn append_part(
    corners: &mut Vec<Corner>,
    polygon: Range<usize>,
    (plane, border): (&Plane, BorderLine),
    distances_m: &[f64],
) {
    let new = (*plane, border);
    let n = polygon.len();
    for i in 0..n {
        let (here, d) = (corners[polygon.start + i], distances_m[i]);
        let (next, d_next) = (corners[polygon.start + (i + 1) % n], distances_m[(i + 1) % n]);
        if d >= 0.0 {
            // A corner on the plane whose edge leaves the part starts the new edge.
            let (edge, border) = if d == 0.0 && d_next < 0.0 { new } else { (here.edge, here.border) };
            corners.push(Corner { edge, border, ..here });
        }
        if (d > 0.0 && d_next < 0.0) || (d < 0.0 && d_next > 0.0) {
            let point_m = here.point_m.lerp(next.point_m, d / (d - d_next));
            let (edge, border) = if d > 0.0 { new } else { (here.edge, here.border) };
            corners.push(Corner { point_m, edge, border });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::border::Border;

    const TOLERANCE_M: f64 = 1e-13;

    fn square() -> Vec<Corner> {
        let corner = |x: f64, y: f64, inward: DVec3| Corner {
            point_m: DVec3::new(x, y, 0.0),
            edge: Plane { normal: inward, offset_m: inward.dot(DVec3::new(x, y, 0.0)) },
            border: Border::Own.into(),
        };
        vec![
            corner(0.0, 0.0, DVec3::Y),
            corner(1.0, 0.0, -DVec3::X),
            corner(1.0, 1.0, -DVec3::Y),
            corner(0.0, 1.0, DVec3::X),
        ]
    }

    fn area(corners: &[Corner]) -> f64 {
        0.5 * doubled_area(corners.iter().map(|c| c.point_m)).z
    }

    #[test]
    fn both_parts_add_to_the_whole_and_every_edge_lies_on_its_plane() {
        for k in 0..360 {
            let (sin, cos) = f64::from(k).to_radians().sin_cos();
            let normal = DVec3::new(cos, sin, 0.3).normalize_or_zero();
            let plane = Plane { normal, offset_m: normal.dot(DVec3::new(0.4, 0.6, 0.0)) };
            let mut corners = square();
            let split = split(&mut corners, 0..4, &plane, Border::Shadow, TOLERANCE_M, &mut Vec::new());
            let Split::Cut { inside, outside } = split else { panic!("{k}: {split:?}") };
            let (inside, outside) = (&corners[inside], &corners[outside]);
            assert!((area(inside) + area(outside) - 1.0).abs() < 4.0 * f64::EPSILON, "{k}");
            for part in [inside, outside] {
                for (c, next) in part.iter().zip(part.iter().cycle().skip(1)) {
                    assert!(
                        c.edge.distance_m(c.point_m).abs() < 1e-15
                            && c.edge.distance_m(next.point_m).abs() < 1e-15
                    );
                    assert!(part.iter().all(|other| c.edge.distance_m(other.point_m) > -1e-15));
                }
            }
        }
    }

    #[test]
    fn a_plane_along_an_edge_or_through_a_corner_cuts_nothing_off() {
        let mut corners = square();
        let along = Plane { normal: DVec3::X, offset_m: 0.5 * TOLERANCE_M };
        assert_eq!(
            split(&mut corners, 0..4, &along, Border::Shadow, TOLERANCE_M, &mut Vec::new()),
            Split::Inside
        );
        assert_eq!(
            split(&mut corners, 0..4, &-along, Border::Shadow, TOLERANCE_M, &mut Vec::new()),
            Split::Outside
        );
        assert_eq!(corners.len(), 4);
    }

    #[test]
    fn a_cut_through_two_corners_makes_two_triangles() {
        let normal = DVec3::new(1.0, -1.0, 0.0) / 2.0_f64.sqrt();
        let mut corners = square();
        let split = split(
            &mut corners,
            0..4,
            &Plane { normal, offset_m: 0.0 },
            Border::Shadow,
            TOLERANCE_M,
            &mut Vec::new(),
        );
        let Split::Cut { inside, outside } = split else { panic!("{split:?}") };
        assert_eq!((inside.len(), outside.len()), (3, 3));
        assert!(
            (area(&corners[inside]) - 0.5).abs() < 1e-15 && (area(&corners[outside]) - 0.5).abs() < 1e-15
        );
    }
}
