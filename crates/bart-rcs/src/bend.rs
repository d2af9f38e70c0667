//! The height of a curved skin over a flat facet: a cubic in barycentric coordinates λ.
//!
//! Beams end on the flat facet; physical optics is integrated over the skin above it, point for point along the facet's
//! normal. With h the height, its points are x + h·n and its area vector per area of the facet is n − ∇h.

use crate::world::FacetGeometry;
use glam::{DMat3, DVec3};

/// Heights of the six control points beside a cubic's corners: on side k (from corner k to the next) the one nearer to its
/// start and the one nearer to its end, m along the normal of the winding.
pub(crate) type ControlHeights = [f64; 6];

/// A skin over one facet.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bend {
    corners_m: [DVec3; 3],
    /// Unit, by the winding.
    pub(crate) normal: DVec3,
    /// ∇λ of each corner, 1/m.
    gradients: [DVec3; 3],
    heights_m: ControlHeights,
    /// Of the control point in the middle: with it the cubic has every quadratic exactly (Farin 1986).
    middle_m: f64,
}

impl Bend {
    /// `None` over a facet without a plane and where the skin is the facet.
    pub(crate) fn over(facet: &FacetGeometry, heights_m: &ControlHeights) -> Option<Self> {
        if !facet.has_plane() || heights_m.iter().all(|h| *h == 0.0) {
            return None;
        }
        let (corners_m, normal) = (facet.corners_m, facet.normal());
        let opposite = |i: usize| corners_m[(i + 2) % 3] - corners_m[(i + 1) % 3];
        let gradients = [0, 1, 2].map(|i| normal.cross(opposite(i)) / (2.0 * facet.area_m2));
        let middle_m = 0.25 * heights_m.iter().sum::<f64>();
        Some(Self { corners_m, normal, gradients, heights_m: *heights_m, middle_m })
    }

    /// Height of the skin over a point of the facet's plane, m along `normal`, and its gradient in the plane.
    pub(crate) fn at(&self, x_m: DVec3) -> (f64, DVec3) {
        let l = [0, 1, 2].map(|i| self.gradients[i].dot(x_m - self.corners_m[(i + 1) % 3]));
        let mut height = 6.0 * self.middle_m * l[0] * l[1] * l[2];
        let mut by_lambda = [0, 1, 2].map(|i| 6.0 * self.middle_m * l[(i + 1) % 3] * l[(i + 2) % 3]);
        for (k, j) in SIDES {
            let [from, to] = self.of_side(k);
            height += 3.0 * l[k] * l[j] * (from * l[k] + to * l[j]);
            by_lambda[k] += 6.0 * from * l[k] * l[j] + 3.0 * to * l[j] * l[j];
            by_lambda[j] += 3.0 * from * l[k] * l[k] + 6.0 * to * l[k] * l[j];
        }
        (height, (0..3).map(|i| by_lambda[i] * self.gradients[i]).sum())
    }

    /// Bounds of the height's second and third derivatives in any directions, 1/m and 1/m². Second ones are linear over
    /// the facet and so the largest at a corner.
    pub(crate) fn derivatives(&self) -> [f64; 2] {
        let at_corners = [0, 1, 2].map(|corner| self.second(corner));
        let mean = (at_corners[0] + at_corners[1] + at_corners[2]) * (1.0 / 3.0);
        let second = at_corners.map(norm).into_iter().fold(0.0, f64::max);
        let third = (0..3).map(|i| norm(at_corners[i] - mean) * self.gradients[i].length()).sum();
        [second, third]
    }

    /// Second derivatives at a corner.
    fn second(&self, corner: usize) -> DMat3 {
        let l = [0, 1, 2].map(|i| f64::from(u8::from(i == corner)));
        let outer = |a: usize, b: usize| {
            let (p, q) = (self.gradients[a], self.gradients[b]);
            DMat3::from_cols(p * q.x, p * q.y, p * q.z)
        };
        let mixed = |a: usize, b: usize| outer(a, b) + outer(b, a);
        let middle = (0..3).map(|i| mixed((i + 1) % 3, (i + 2) % 3) * (6.0 * self.middle_m * l[i]));
        let sides = SIDES.into_iter().map(|(k, j)| {
            let [from, to] = self.of_side(k);
            outer(k, k) * (6.0 * from * l[j])
                + outer(j, j) * (6.0 * to * l[k])
                + mixed(k, j) * (6.0 * (from * l[k] + to * l[j]))
        });
        middle.chain(sides).fold(DMat3::ZERO, |sum, m| sum + m)
    }

    fn of_side(&self, k: usize) -> [f64; 2] {
        [self.heights_m[2 * k], self.heights_m[2 * k + 1]]
    }
}

const SIDES: [(usize, usize); 3] = [(0, 1), (1, 2), (2, 0)];

/// Frobenius: at least the largest of all directions.
fn norm(m: DMat3) -> f64 {
    (m.x_axis.length_squared() + m.y_axis.length_squared() + m.z_axis.length_squared()).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::Plane;
    use artifact::paths::Facet;

    fn bend() -> Bend {
        let corners_m = [DVec3::new(0.0, 0.1, 0.0), DVec3::new(0.3, 0.0, 0.1), DVec3::new(0.1, 0.25, 0.2)];
        let plane = Plane::of_triangle(&corners_m).unwrap();
        let [a, b, c] = corners_m;
        let area_m2 = 0.5 * (b - a).cross(c - a).length();
        let facet = FacetGeometry { corners_m, plane, area_m2, id: Facet::default() };
        Bend::over(&facet, &[1e-3, 3e-3, -2e-3, 1e-3, 4e-3, 2e-3]).unwrap()
    }

    #[test]
    fn the_gradient_is_the_heights_and_the_bounds_hold_its_changes() {
        let bend = bend();
        let inside = |u: f64, v: f64| {
            let [a, b, c] = bend.corners_m;
            a + u * (b - a) + v * (c - a)
        };
        let [second, third] = bend.derivatives();
        let mut largest = 0.0_f64;
        for (u, v) in [(0.2, 0.3), (0.6, 0.1), (0.1, 0.8)] {
            let (x, step) = (inside(u, v), 1e-5 * (inside(1.0, 0.0) - inside(0.0, 1.0)));
            let [(low, from), (high, to)] = [bend.at(x - step), bend.at(x + step)];
            let (_, gradient) = bend.at(x);
            // Central differences of a cubic err by the third derivative's step²/6.
            assert!((high - low - 2.0 * gradient.dot(step)).abs() < third * step.length().powi(3));
            largest = largest.max((to - from).length() / (2.0 * step.length()));
        }
        println!("second derivatives up to {largest:.3}/m, bound {second:.3}/m");
        assert!(largest <= second && largest > 0.2 * second);
        assert!(bend.corners_m.iter().all(|c| bend.at(*c).0.abs() < 1e-17));
    }
}
