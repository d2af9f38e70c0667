//! Height of a curved skin over a flat facet: a cubic in barycentric coordinates λ.
//!
//! Beams end on the flat facet; physical optics is integrated over the skin above it, point by point along
//! the facet's normal. With h the height, its points are x + h·n and its area vector per area of the facet is
//! n − ∇h.

use crate::geometry::facet_geometry::FacetGeometry;
use glam::{DMat3, DVec3};

/// Heights of the six control points other than a cubic's corners: on side k (from corner k to the next) the
/// one nearer to its start and the one nearer to its end, m along the normal by winding.
pub(crate) type ControlHeights = [f64; 6];

/// A skin over one facet.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bend {
    corners_m: [DVec3; 3],
    /// Unit normal by winding.
    pub(crate) normal: DVec3,
    /// Gradients ∇λ of each corner, 1/m.
    gradients: [DVec3; 3],
    heights_m: ControlHeights,
    /// Height of the central control point, for which the cubic reproduces every quadratic exactly (Farin
    /// 1986).
    middle_m: f64,
    /// Second derivatives H at the corners, 1/m; linear between them.
    second_per_m: [DMat3; 3],
}

/// Maximum rise and slope change of a skin along several steps, anywhere over its facet.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct SkinVariation {
    /// Second difference e·He of the height, m: twice its rise beyond the tangent plane.
    pub(crate) rise_m: f64,
    /// Third derivative of the height, m.
    pub(crate) third_m: f64,
    /// Change |He| of the slope.
    pub(crate) turn: f64,
    /// Second derivative of the slope.
    pub(crate) turn_second: f64,
}

impl Bend {
    /// Skin over a facet; `None` if the facet has no plane or is the surface itself.
    pub(crate) fn over(facet: &FacetGeometry, heights_m: &ControlHeights) -> Option<Self> {
        let is_bent = facet.has_plane() && heights_m.iter().any(|h| *h != 0.0);
        is_bent.then(|| Self::new(facet.corners_m, facet.normal(), heights_m))
    }

    /// Skin over a triangle of non-zero area.
    pub(crate) fn new(corners_m: [DVec3; 3], normal: DVec3, heights_m: &ControlHeights) -> Self {
        let [a, b, c] = corners_m;
        let doubled_area_m2 = (b - a).cross(c - a).length();
        let opposite = |i: usize| corners_m[(i + 2) % 3] - corners_m[(i + 1) % 3];
        let gradients = [0, 1, 2].map(|i| normal.cross(opposite(i)) / doubled_area_m2);
        let middle_m = 0.25 * heights_m.iter().sum::<f64>();
        let second_per_m = [DMat3::ZERO; 3];
        let mut bend = Self { corners_m, normal, gradients, heights_m: *heights_m, middle_m, second_per_m };
        bend.second_per_m = [0, 1, 2].map(|corner| bend.second(corner));
        bend
    }

    /// Maximum slope at the corners and at the centre.
    pub(crate) fn steepest(&self) -> f64 {
        let [a, b, c] = self.corners_m;
        [a, b, c, (a + b + c) / 3.0].map(|x| self.at(x).1.length()).into_iter().fold(0.0, f64::max)
    }

    /// Bound on the slope anywhere: the slope is of second degree, and nowhere larger than its largest
    /// control vector (Farin 1986). A needle can be flat at its corners and centre, and vertical between
    /// them.
    pub(crate) fn steepest_bound(&self) -> f64 {
        let [next, before] = [|k: usize| (k + 1) % 3, |k: usize| (k + 2) % 3];
        let of_corner = |k: usize| {
            let (from, to) = (self.of_side(k)[0], self.of_side(before(k))[1]);
            from * self.gradients[next(k)] + to * self.gradients[before(k)]
        };
        let of_side = |k: usize| {
            let [from, to] = self.of_side(k);
            from * self.gradients[k]
                + to * self.gradients[next(k)]
                + self.middle_m * self.gradients[before(k)]
        };
        (0..3).flat_map(|k| [of_corner(k), of_side(k)]).map(|slope| 3.0 * slope.length()).fold(0.0, f64::max)
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

    /// Bounds over the facet for these steps in its plane. A long facet bent transversely has none
    /// lengthwise.
    pub(crate) fn along(&self, steps_m: impl Iterator<Item = DVec3>) -> SkinVariation {
        steps_m.map(|step| self.along_one(step)).fold(SkinVariation::default(), |most, one| SkinVariation {
            rise_m: most.rise_m.max(one.rise_m),
            third_m: most.third_m.max(one.third_m),
            turn: most.turn.max(one.turn),
            turn_second: most.turn_second.max(one.turn_second),
        })
    }

    fn along_one(&self, step_m: DVec3) -> SkinVariation {
        let turns = self.second_per_m.map(|h| h * step_m);
        let change: DVec3 = (0..3).map(|i| turns[i] * self.gradients[i].dot(step_m)).sum();
        SkinVariation {
            rise_m: turns.iter().map(|turn| turn.dot(step_m).abs()).fold(0.0, f64::max),
            third_m: change.dot(step_m).abs(),
            turn: turns.iter().map(|turn| turn.length()).fold(0.0, f64::max),
            turn_second: change.length(),
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::plane::Plane;
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
        for (u, v) in [(0.2, 0.3), (0.6, 0.1), (0.1, 0.8)] {
            let (x, step) = (inside(u, v), 1e-2 * (inside(1.0, 0.0) - inside(0.0, 1.0)));
            let [(low, from), (high, to)] = [bend.at(x - step), bend.at(x + step)];
            let ((middle, gradient), along) = (bend.at(x), bend.along([step].into_iter()));
            // Central differences of a cubic err by a sixth of its third derivative; those of second order
            // are exact.
            let first = 0.5 * (high - low) - gradient.dot(step);
            assert!((first.abs() - along.third_m / 6.0).abs() < 1e-14);
            let [second, turn] = [(high - 2.0 * middle + low).abs(), 0.5 * (to - from).length()];
            println!("rise {second:.2e} of {:.2e} m, turn {turn:.2e} of {:.2e}", along.rise_m, along.turn);
            assert!(second <= along.rise_m && turn <= along.turn + 1e-15);
            assert!(along.turn < 10.0 * turn);
        }
        assert!(bend.corners_m.iter().all(|c| bend.at(*c).0.abs() < 1e-17));
    }

    #[test]
    fn no_slope_of_the_skin_is_steeper_than_its_bound_nor_half_as_steep() {
        let bend = bend();
        let [a, b, c] = bend.corners_m;
        let places =
            (0..=20).flat_map(|i| (0..=20 - i).map(move |j| (f64::from(i) / 20.0, f64::from(j) / 20.0)));
        let slopes = places.map(|(u, v)| bend.at(a + u * (b - a) + v * (c - a)).1.length());
        let (found, bound) = (slopes.fold(0.0, f64::max), bend.steepest_bound());
        println!("steepest {found:.4}, bound {bound:.4}");
        assert!(found <= bound * (1.0 + 1e-12) && bound < 2.0 * found);
    }
}
