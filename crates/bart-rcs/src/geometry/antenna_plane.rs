//! Planes through an antenna and an edge, or through an antenna and the intersection of two planes.

use crate::geometry::antenna::Antenna;
use crate::geometry::plane::{Plane, accurate_cross};
use glam::DVec3;

impl Plane {
    /// Plane through an antenna and the edge `from`–`to`, positive to the left of the edge as seen by the
    /// antenna.
    ///
    /// Both senses of an edge give exactly opposite planes: two facets that share it leave no gap and no
    /// overlap, bit for bit. `None` if the antenna lies on the edge's line.
    pub fn through_edge(antenna: Antenna, from: DVec3, to: DVec3) -> Option<Self> {
        let forwards = is_before(from, to);
        let (a, b) = if forwards { (from, to) } else { (to, from) };
        let plane = Self::along(accurate_cross(antenna.towards(a), b - a), a)?;
        Some(if forwards { plane } else { -plane })
    }

    /// Plane through an antenna and the intersection of two planes: d_a(y)·d_b(p) − d_b(y)·d_a(p) vanishes at
    /// the antenna p and on the line. On `b` it has the sign of d_a times that of the antenna's side of `b`;
    /// exchanging `a` and `b` reverses it exactly. `None` if the planes coincide or the antenna is on the
    /// line.
    pub fn through_meeting(antenna: Antenna, a: &Self, b: &Self) -> Option<Self> {
        let (of_a, of_b) = (a.side_of(antenna), b.side_of(antenna));
        let normal = of_b * a.normal - of_a * b.normal;
        let length = normal.length();
        let offset_m = of_b * a.offset_m - of_a * b.offset_m;
        (length > 0.0 && length.is_finite())
            .then(|| Self { normal: normal / length, offset_m: offset_m / length })
    }

    /// Signed distance of an antenna, m, or for a direction the cosine of its angle to the normal.
    pub fn side_of(&self, antenna: Antenna) -> f64 {
        match antenna {
            Antenna::Point(p) => self.distance_m(p),
            Antenna::Direction(r) => self.normal.dot(r),
        }
    }
}

/// Order of points by their coordinates: the canonical direction of an edge, independent of its corners'
/// indices.
fn is_before(a: DVec3, b: DVec3) -> bool {
    (a.x, a.y, a.z) < (b.x, b.y, b.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: DVec3 = DVec3::new(0.1, 0.2, 0.3);
    const B: DVec3 = DVec3::new(-1.3, 0.7, 2.0);

    #[test]
    fn an_edge_walked_both_ways_gives_exactly_opposite_planes() {
        for antenna in
            [Antenna::Point(DVec3::new(5.0, 6.0, 7.0)), Antenna::Direction(DVec3::new(0.36, 0.48, 0.8))]
        {
            let forth = Plane::through_edge(antenna, A, B).unwrap();
            let back = Plane::through_edge(antenna, B, A).unwrap();
            assert_eq!(forth, -back);
        }
    }

    #[test]
    fn the_positive_side_of_an_edge_is_to_its_left_as_the_antenna_sees_it() {
        let (from, to) = (DVec3::ZERO, DVec3::X);
        for antenna in [Antenna::Point(DVec3::Z * 3.0), Antenna::Direction(DVec3::Z)] {
            let plane = Plane::through_edge(antenna, from, to).unwrap();
            assert!(plane.distance_m(DVec3::Y) > 0.9);
        }
    }

    #[test]
    fn the_plane_through_a_meeting_holds_the_antenna_and_the_line() {
        let a = Plane { normal: DVec3::Z, offset_m: 0.5 };
        let b = Plane { normal: DVec3::new(0.6, 0.0, 0.8), offset_m: 1.0 };
        let p = DVec3::new(2.0, 1.0, 3.0);
        let plane = Plane::through_meeting(Antenna::Point(p), &a, &b).unwrap();
        let line = |y: f64| DVec3::new(1.0, y, 0.5);
        // Products of up to 8 m² over the normal's length of 1.6 m, some four roundings each.
        assert!([p, line(0.0), line(3.0)].iter().all(|&x| plane.distance_m(x).abs() < 20.0 * f64::EPSILON));
        assert_eq!(Plane::through_meeting(Antenna::Point(p), &b, &a), Some(-plane));
        assert_eq!(Plane::through_meeting(Antenna::Point(p), &a, &a), None);
    }

    #[test]
    fn an_antenna_on_the_line_of_an_edge_has_no_plane_through_it() {
        assert_eq!(Plane::through_edge(Antenna::Point(2.0 * DVec3::X), DVec3::ZERO, DVec3::X), None);
    }
}
