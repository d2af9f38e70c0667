//! Planes in Hesse form: those of facets, and their mirror images.

use glam::DVec3;

/// Plane of all x with n·x = offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Unit normal n.
    pub normal: DVec3,
    /// Value of n·x on the plane, m.
    pub offset_m: f64,
}

impl Plane {
    /// Signed distance, positive on the side of the normal.
    #[inline]
    pub fn distance_m(&self, x_m: DVec3) -> f64 {
        self.normal.dot(x_m) - self.offset_m
    }

    /// Plane of a triangle, with its normal by the winding; `None` if the corners span none.
    pub fn of_triangle(corners_m: &[DVec3; 3]) -> Option<Self> {
        let [a, b, c] = *corners_m;
        // The corner opposite the longest edge has the best conditioned pair of edges; the choice and its
        // rounding must not depend on which corner is named first, or a rotated index triple would give
        // another plane.
        let (origin, u, v) =
            [(a, b - a, c - a), (b, c - b, a - b), (c, a - c, b - c)].into_iter().min_by(|l, r| {
                let longest = |t: &(DVec3, DVec3, DVec3)| t.1.length_squared().max(t.2.length_squared());
                longest(l).total_cmp(&longest(r))
            })?;
        let normal = accurate_cross(u, v).try_normalize()?;
        Some(Self { normal, offset_m: normal.dot(origin) })
    }

    /// Image behind a mirror; points on the mirror keep their distances.
    pub fn mirrored(&self, mirror: &Self) -> Self {
        let twice_cosine = 2.0 * self.normal.dot(mirror.normal);
        Self {
            normal: self.normal - twice_cosine * mirror.normal,
            offset_m: self.offset_m - twice_cosine * mirror.offset_m,
        }
    }

    /// Minimum and maximum distance of a triangle's corners, m.
    pub(crate) fn extent_m(&self, corners_m: &[DVec3; 3]) -> (f64, f64) {
        let [a, b, c] = corners_m.map(|corner| self.distance_m(corner));
        (a.min(b).min(c), a.max(b).max(c))
    }

    /// Plane through `x_m` with a normal along `direction`.
    pub(crate) fn along(direction: DVec3, x_m: DVec3) -> Option<Self> {
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

/// Cross product u × v, accurate to rounding of each component, however small relative to |u||v|.
///
/// The plain formula errs by ε|u||v|: the plane of a needle of 1 m × 1 µm would miss its own corners by 1e-10
/// m, a thousand times the tolerance of a world, and a doubled needle would be lit twice.
pub(crate) fn accurate_cross(u: DVec3, v: DVec3) -> DVec3 {
    DVec3::new(
        difference_of_products(u.y, v.z, u.z, v.y),
        difference_of_products(u.z, v.x, u.x, v.z),
        difference_of_products(u.x, v.y, u.y, v.x),
    )
}

/// Difference ab − cd with an error of 1.5 ulp: Kahan's algorithm (Jeannerod, Louvet, Muller, Math.
/// Comp. 82 (2013) 2245).
fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let product = c * d;
    let error = c.mul_add(-d, product);
    a.mul_add(b, -product) + error
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: DVec3 = DVec3::new(0.1, 0.2, 0.3);
    const B: DVec3 = DVec3::new(-1.3, 0.7, 2.0);

    #[test]
    fn the_plane_of_a_needle_holds_its_corners() {
        let middle = 0.5 * (A + B) + DVec3::new(1e-9, -2e-9, 3e-9);
        for corners in [[A, B, middle], [B, A, middle], [middle, A, B]] {
            let plane = Plane::of_triangle(&corners).unwrap();
            // Rounding of the corners' differences and of n·x: a few ε of the largest coordinate.
            assert!(
                corners.iter().all(|&c| plane.distance_m(c).abs() < 8.0 * f64::EPSILON * 2.0),
                "{plane:?}"
            );
        }
    }

    #[test]
    fn what_spans_no_plane_gives_none() {
        assert_eq!(Plane::of_triangle(&[A, B, A]), None);
        assert_eq!(Plane::of_triangle(&[DVec3::ZERO, DVec3::X, 2.0 * DVec3::X]), None);
    }
}
