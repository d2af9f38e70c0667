//! Triangulation of a polygon.

use glam::{DVec2, DVec3};

/// The corners of a polygon's triangles, with its winding, by ear cutting, so that a concave polygon keeps
/// its area. The number of comparisons of places is added to `comparisons`.
pub(crate) fn triangulate(points: &[DVec3], comparisons: &mut u64) -> Vec<[usize; 3]> {
    let flat = projected(points);
    let mut left: Vec<usize> = (0..points.len()).collect();
    let mut triangles = Vec::with_capacity(points.len().saturating_sub(2));
    while left.len() > 3 {
        // A self-intersecting polygon may have no ear: then any corner is cut, and none is lost.
        let ear = (0..left.len()).find(|&i| is_ear(&flat, &left, i, comparisons)).unwrap_or(1);
        triangles.push(corners_at(&left, ear));
        left.remove(ear);
    }
    if let [a, b, c] = left[..] {
        triangles.push([a, b, c]);
    }
    triangles
}

/// Projection onto the coordinate plane with the polygon's largest area, wound counter-clockwise there.
fn projected(points: &[DVec3]) -> Vec<DVec2> {
    let origin = points.first().copied().unwrap_or_default();
    let area =
        points.windows(2).fold(DVec3::ZERO, |sum, pair| sum + (pair[0] - origin).cross(pair[1] - origin));
    let size = area.abs();
    let flatten = |v: DVec3| match size.max_element() {
        m if m == size.x => DVec2::new(v.y, v.z * area.x.signum()),
        m if m == size.y => DVec2::new(v.z, v.x * area.y.signum()),
        _ => DVec2::new(v.x, v.y * area.z.signum()),
    };
    points.iter().map(|point| flatten(*point - origin)).collect()
}

fn corners_at(left: &[usize], i: usize) -> [usize; 3] {
    let count = left.len();
    [left[(i + count - 1) % count], left[i], left[(i + 1) % count]]
}

/// Whether the corner points outward and no reflex corner lies in its triangle. One at the place of a
/// neighbour does not count: an outline that walks to a hole and back has each end of that way twice.
fn is_ear(flat: &[DVec2], left: &[usize], i: usize, comparisons: &mut u64) -> bool {
    let corners = corners_at(left, i);
    let [a, b, c] = corners.map(|index| flat[index]);
    let side = |p: DVec2, q: DVec2, x: DVec2| (q - p).perp_dot(x - p);
    let inside = |x: DVec2| side(a, b, x) >= 0.0 && side(b, c, x) >= 0.0 && side(c, a, x) >= 0.0;
    *comparisons += 1;
    let points_outward = side(a, b, c) > 0.0;
    if !points_outward {
        return false;
    }
    let count = left.len();
    let blocks = |j: usize| {
        let x = flat[left[j]];
        let is_reflex = || side(flat[left[(j + count - 1) % count]], x, flat[left[(j + 1) % count]]) <= 0.0;
        !corners.contains(&left[j]) && x != a && x != c && inside(x) && is_reflex()
    };
    let other = (0..count).find(|&j| blocks(j));
    *comparisons += other.unwrap_or(left.len()) as u64;
    other.is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[DVec3]) -> f64 {
        let of = |[a, b, c]: [usize; 3]| 0.5 * (points[b] - points[a]).cross(points[c] - points[a]).z;
        let areas: Vec<f64> = triangulate(points, &mut 0).into_iter().map(of).collect();
        assert!(areas.iter().all(|area| *area >= 0.0), "{areas:?}");
        areas.iter().sum()
    }

    #[test]
    fn a_hole_that_the_outline_walks_to_and_back_stays_open() {
        let outline = [
            (0.0, 0.0),
            (4.0, 0.0),
            (4.0, 4.0),
            (0.0, 4.0),
            (0.0, 0.0),
            (1.0, 1.0),
            (1.0, 3.0),
            (3.0, 3.0),
            (3.0, 1.0),
            (1.0, 1.0),
        ];
        for first in 0..outline.len() {
            let turned = outline.iter().cycle().skip(first).take(outline.len());
            let points: Vec<DVec3> = turned.map(|&(x, y)| DVec3::new(x, y, 0.0)).collect();
            assert_eq!(area(&points), 12.0, "from corner {first}");
        }
    }

    #[test]
    fn a_corner_named_twice_in_a_row_changes_nothing() {
        let outline = [(1.0, 1.0), (1.0, 2.0), (0.0, 2.0), (0.0, 0.0), (2.0, 0.0), (2.0, 1.0)];
        for twice in 0..outline.len() {
            let mut points: Vec<DVec3> = outline.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect();
            points.insert(twice, points[twice]);
            assert_eq!(area(&points), 3.0, "corner {twice}");
        }
    }

    #[test]
    fn a_dented_polygon_keeps_its_area_and_winding_in_every_plane() {
        // An L of area 3, counter-clockwise in (u, v); a fan from its first corner would cover area outside.
        let outline = [(1.0, 1.0), (1.0, 2.0), (0.0, 2.0), (0.0, 0.0), (2.0, 0.0), (2.0, 1.0)];
        let planes: [fn(f64, f64) -> DVec3; 4] = [
            |u, v| DVec3::new(u, v, 0.0),
            |u, v| DVec3::new(v, u, 0.3),
            |u, v| DVec3::new(0.0, u, v),
            |u, v| DVec3::new(v, 5.0, u),
        ];
        for plane in planes {
            let points: Vec<DVec3> = outline.iter().map(|&(u, v)| plane(u, v)).collect();
            let up = (plane(1.0, 0.0) - plane(0.0, 0.0)).cross(plane(0.0, 1.0) - plane(0.0, 0.0));
            let areas = triangulate(&points, &mut 0).into_iter().map(|t| {
                let [a, b, c] = t.map(|i| points[i]);
                0.5 * (b - a).cross(c - a).dot(up)
            });
            let areas: Vec<f64> = areas.collect();
            assert_eq!(areas.len(), 4);
            assert!(areas.iter().all(|area| *area >= 0.0), "{areas:?}");
            // Sums of small integers and halves: exact.
            assert_eq!(areas.iter().sum::<f64>(), 3.0);
        }
    }
}
