//! Planes in Hesse form: of a facet, and through an antenna and an edge.

use crate::geometry::antenna::Antenna;
use glam::DVec3;

/// All x with n·x = offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Unit normal n.
    pub normal: DVec3,
    /// n·x on the plane, m.
    pub offset_m: f64,
}

impl Plane {
    /// Signed distance, positive on the side that the normal points to.
    #[inline]
    pub fn distance_m(&self, x_m: DVec3) -> f64 {
        self.normal.dot(x_m) - self.offset_m
    }

    /// The plane of a triangle, its normal by the winding; `None` where the corners span none.
    pub fn of_triangle(corners_m: &[DVec3; 3]) -> Option<Self> {
        let [a, b, c] = *corners_m;
        // The corner opposite the longest edge has the best conditioned pair of edges; the choice and its rounding must not
        // depend on which corner is named first, or a rotated index triple would be another plane.
        let (origin, u, v) = [(a, b - a, c - a), (b, c - b, a - b), (c, a - c, b - c)].into_iter().min_by(|l, r| {
            let longest = |t: &(DVec3, DVec3, DVec3)| t.1.length_squared().max(t.2.length_squared());
            longest(l).total_cmp(&longest(r))
        })?;
        let normal = accurate_cross(u, v).try_normalize()?;
        Some(Self { normal, offset_m: normal.dot(origin) })
    }

    /// The plane through an antenna and the edge `from`–`to`, positive to the left of the edge as the antenna sees it.
    ///
    /// Both ways along an edge give exactly opposite planes: two facets that share it leave no gap and no overlap, bit by
    /// bit. `None` where the antenna lies on the edge's line.
    pub fn through_edge(antenna: Antenna, from: DVec3, to: DVec3) -> Option<Self> {
        let forwards = is_before(from, to);
        let (a, b) = if forwards { (from, to) } else { (to, from) };
        let plane = Self::along(accurate_cross(antenna.towards(a), b - a), a)?;
        Some(if forwards { plane } else { -plane })
    }

    /// The plane through an antenna and the line where two planes meet: d_a(y)·d_b(p) − d_b(y)·d_a(p) vanishes at the antenna
    /// p and on the line. On `b` it has the sign of d_a times that of the antenna's side of `b`; exchanging `a` and `b`
    /// turns it over exactly. `None` where the planes are one or the antenna is on the line.
    pub fn through_meeting(antenna: Antenna, a: &Self, b: &Self) -> Option<Self> {
        let (of_a, of_b) = (a.side_of(antenna), b.side_of(antenna));
        let normal = of_b * a.normal - of_a * b.normal;
        let length = normal.length();
        let offset_m = of_b * a.offset_m - of_a * b.offset_m;
        (length > 0.0 && length.is_finite()).then(|| Self { normal: normal / length, offset_m: offset_m / length })
    }

    /// The image behind a mirror; points on the mirror keep their distances.
    pub fn mirrored(&self, mirror: &Self) -> Self {
        let twice_cosine = 2.0 * self.normal.dot(mirror.normal);
        Self {
            normal: self.normal - twice_cosine * mirror.normal,
            offset_m: self.offset_m - twice_cosine * mirror.offset_m,
        }
    }

    /// Signed distance of an antenna, m, or the cosine of its direction to the normal.
    pub fn side_of(&self, antenna: Antenna) -> f64 {
        match antenna {
            Antenna::Point(p) => self.distance_m(p),
            Antenna::Direction(r) => self.normal.dot(r),
        }
    }

    /// Least and greatest distance of the corners of a triangle, m.
    pub(crate) fn extent_m(&self, corners_m: &[DVec3; 3]) -> (f64, f64) {
        let [a, b, c] = corners_m.map(|corner| self.distance_m(corner));
        (a.min(b).min(c), a.max(b).max(c))
    }

    /// The plane with a normal along `direction` through `x_m`.
    fn along(direction: DVec3, x_m: DVec3) -> Option<Self> {
        let normal = direction.try_normalize()?;
        Some(Self { normal, offset_m: normal.dot(x_m) })
    }
}

impl std::ops::Neg for Plane {
    type Output = Self;

    fn neg(self) -> Self {
        Self { normal: -self.normal, offset_m: -self.offset_m }
    }
}

/// u × v to rounding of each component, however small it is beside |u||v|.
///
/// The plain formula errs by ε|u||v|: the plane of a needle of 1 m × 1 µm would miss its own corners by 1e-10 m, a thousand
/// times the tolerance of a world, and a doubled needle would be lit twice.
fn accurate_cross(u: DVec3, v: DVec3) -> DVec3 {
    DVec3::new(
        difference_of_products(u.y, v.z, u.z, v.y),
        difference_of_products(u.z, v.x, u.x, v.z),
        difference_of_products(u.x, v.y, u.y, v.x),
    )
}

/// ab − cd with an error of 1.5 ulp: Kahan's algorithm (Jeannerod, Louvet, Muller, Math. Comp. 82 (2013) 2245).
fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let product = c * d;
    let error = c.mul_add(-d, product);
    a.mul_add(b, -product) + error
}

/// Order of points by their coordinates: the canonical direction of an edge, whatever the indices of its corners are.
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
        for antenna in [Antenna::Point(DVec3::new(5.0, 6.0, 7.0)), Antenna::Direction(DVec3::new(0.36, 0.48, 0.8))] {
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
    fn the_plane_of_a_needle_holds_its_corners() {
        let middle = 0.5 * (A + B) + DVec3::new(1e-9, -2e-9, 3e-9);
        for corners in [[A, B, middle], [B, A, middle], [middle, A, B]] {
            let plane = Plane::of_triangle(&corners).unwrap();
            // Rounding of the corners' differences and of n·x: a few ε of the largest coordinate.
            assert!(corners.iter().all(|&c| plane.distance_m(c).abs() < 8.0 * f64::EPSILON * 2.0), "{plane:?}");
        }
    }

    #[test]
    fn what_spans_no_plane_gives_none() {
        assert_eq!(Plane::of_triangle(&[A, B, A]), None);
        assert_eq!(Plane::of_triangle(&[DVec3::ZERO, DVec3::X, 2.0 * DVec3::X]), None);
        assert_eq!(Plane::through_edge(Antenna::Point(2.0 * DVec3::X), DVec3::ZERO, DVec3::X), None);
    }
}
