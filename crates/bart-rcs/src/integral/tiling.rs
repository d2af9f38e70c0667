//! Tiling of a lit polygon: subdivision until the integrand satisfies the assumptions of the closed forms.

use crate::geometry::antenna::Antenna;
use crate::geometry::plane_frame::{area_m2, centroid_m};
use crate::integral::field::Field;
use crate::surface::bend::SkinVariation;
use glam::{DMat2, DVec2, DVec3};
use std::ops::ControlFlow;

/// A part of a polygon, in plane coordinates, and the closed form that applies.
pub(crate) enum Tile<'a> {
    /// Weight and curvature of the phase are practically constant.
    Whole { corners_m: &'a [DVec2], centre_m: DVec2 },
    /// Weight times the residual phase is practically quadratic.
    Triangle([DVec2; 3]),
}

impl Tile<'_> {
    /// A central point and the greatest distance of others from it, m.
    pub(crate) fn middle_and_reach_m(&self) -> (DVec2, f64) {
        match self {
            Self::Whole { corners_m, centre_m } => (*centre_m, reach_m(corners_m, *centre_m)),
            Self::Triangle(corners_m) => {
                let centre_m = (corners_m[0] + corners_m[1] + corners_m[2]) / 3.0;
                (centre_m, reach_m(corners_m, centre_m))
            }
        }
    }

    pub(crate) fn corners_m(&self) -> &[DVec2] {
        match self {
            Self::Whole { corners_m, .. } => corners_m,
            Self::Triangle(corners_m) => corners_m,
        }
    }

    /// Steps from the centre to the corners, or along the edges.
    pub(crate) fn steps_m(&self) -> Vec<DVec2> {
        match self {
            Self::Whole { corners_m, centre_m } => corners_m.iter().map(|c| *c - *centre_m).collect(),
            Self::Triangle(corners_m) => edges_m(corners_m).into(),
        }
    }

    pub(crate) fn area_m2(&self) -> f64 {
        match self {
            Self::Whole { corners_m, .. } => area_m2(corners_m),
            Self::Triangle(corners_m) => area_m2(corners_m),
        }
    }
}

/// Passes on tiles that cover the node's polygon, each with an error bound for weight·phase on it.
///
/// The bound is at most `accuracy` except on tiles halved [`HALVINGS_MAX`] times: around a point where the
/// polarization vectors rotate without limit (an antenna straight above) nothing can be expanded, and the
/// remaining area is negligible.
pub(crate) fn cut(
    field: &Field<'_>,
    wavenumber_per_m: f64,
    accuracy: f64,
    give: &mut dyn FnMut(&Tile<'_>, f64),
) {
    let of_triangles = accuracy;
    let _ = subdivide(field, wavenumber_per_m, [accuracy, of_triangles], &mut |tile, error| {
        give(tile, error);
        ControlFlow::Continue(())
    });
}

/// Approximate number of tiles produced by [`cut`], estimated with a hundredth of its work and counted up to
/// `most`.
///
/// The error of a triangle is proportional to the cube of its size: one with q times the allowed error is
/// divided into q^⅔.
pub(crate) fn count(field: &Field<'_>, wavenumber_per_m: f64, accuracy: f64, most: u64) -> u64 {
    let mut tiles = 0;
    let _ = subdivide(field, wavenumber_per_m, [accuracy, COARSER * accuracy], &mut |_, error| {
        let parts = (error / accuracy).powf(2.0 / 3.0).ceil();
        tiles += if parts.is_finite() { parts.max(1.0) as u64 } else { 1 };
        if tiles > most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    tiles
}

/// Factor of the coarser error, 8³: a triangle that would be divided into 64 is not divided.
const COARSER: f64 = 512.0;

/// Subdivides until the error of a whole polygon, or of triangles, is within the limit, or until `give`
/// breaks.
fn subdivide(
    field: &Field<'_>,
    wavenumber_per_m: f64,
    [of_whole, of_triangles]: [f64; 2],
    give: &mut dyn FnMut(&Tile<'_>, f64) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let corners_m: Vec<DVec2> =
        field.node.corners_m.iter().map(|c| field.frame.plane_from_world(*c)).collect();
    let centre_m = centroid_m(&corners_m);
    let along = field.along(corners_m.iter().map(|c| *c - centre_m));
    let smooth = Smoothness::about(field, centre_m, reach_m(&corners_m, centre_m), along, wavenumber_per_m);
    let error = smooth.error_of_constant(&SecondMoment::about(centre_m, &corners_m));
    if error <= of_whole {
        return give(&Tile::Whole { corners_m: &corners_m, centre_m }, error);
    }
    let mut left: Vec<([DVec2; 3], u32)> =
        corners_m[1..].windows(2).rev().map(|pair| ([corners_m[0], pair[0], pair[1]], 0)).collect();
    while let Some((triangle, halvings)) = left.pop() {
        let centre_m = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
        let along = field.along(edges_m(&triangle).into_iter());
        let smooth =
            Smoothness::about(field, centre_m, reach_m(&triangle, centre_m), along, wavenumber_per_m);
        let error = smooth.error_of_quadratic(&triangle, centre_m);
        if error <= of_triangles || halvings == HALVINGS_MAX {
            give(&Tile::Triangle(triangle), error.min(2.0 * smooth.weight))?;
        } else {
            let worst = smooth.worst_edge(field, &edges_m(&triangle));
            left.extend(halves(triangle, worst).into_iter().rev().map(|half| (half, halvings + 1)));
        }
    }
    ControlFlow::Continue(())
}

/// Maximum number of halvings: 2⁻⁴⁸ of a polygon's area is below rounding.
const HALVINGS_MAX: u32 = 48;

/// Bounds on the integrand's variation within `reach_m` of a centre.
struct Smoothness {
    /// Maximum weight: the bracket is at most 2.
    weight: f64,
    /// Weight's relative first, second, third derivative, per m, m², m³.
    weight_derivatives: [f64; 3],
    /// Quadratic form that bounds the second derivative of the phase along the plane anywhere on the tile,
    /// rad/m².
    hessian: DMat2,
    /// Bound on the third derivative of the phase, rad/m³.
    third: f64,
    reach_m: f64,
    /// Bounds on the contribution of a curved facet to the second and third derivative of the phase along the
    /// tile, rad.
    bent_phase: [f64; 2],
    /// Bounds on the contribution of a curved facet to the first and second derivative of the weight.
    bent_weight: [f64; 2],
    /// Phase per metre of height, rad/m.
    phase_of_height_per_m: f64,
}

impl Smoothness {
    fn about(
        field: &Field<'_>,
        centre_m: DVec2,
        reach_m: f64,
        along: SkinVariation,
        wavenumber_per_m: f64,
    ) -> Self {
        let at = field.surface_at(centre_m);
        let x_m = at.x_m;
        let ranges_m = field.ranges_m(x_m);
        let spread =
            |range_m: f64| if range_m.is_finite() { range_m / (range_m - reach_m).max(0.0) } else { 1.0 };
        let nearness_per_m = ranges_m.map(|range_m| 1.0 / (range_m - reach_m).max(0.0));
        let turning_per_m = field.turning_per_m(x_m, reach_m);
        let (t, turns) = (turning_per_m, field.weight_turns(wavenumber_per_m));
        let weight_derivatives = [turns[0] * t, turns[1] * t * t, turns[2] * t * t * t];
        // A step ds along the plane is (1 + slope²)^½ ds along the skin, whose height follows the wave along
        // its normal; the area vector varies with the slope, and the weight w times as fast, because the
        // reflection coefficient at the node varies with it.
        let steep = at.area.length() + along.turn;
        let w = field.turning_with_skin(&at, along.turn, wavenumber_per_m);
        let nearness: f64 = nearness_per_m.iter().sum();
        let phase_of_height_per_m =
            wavenumber_per_m * (field.both_directions(x_m).dot(field.node.normal).abs() + nearness * reach_m);
        let hessian = wavenumber_per_m
            * steep
            * steep
            * Self::length_hessian_per_m(field, x_m, nearness_per_m, reach_m);
        // d³L/ds³ = −3 sin²θ cosθ/L², at most 2/√3 of 1/L².
        let squares: f64 = nearness_per_m.iter().map(|n| 1.155 * n * n).sum();
        let third = wavenumber_per_m * squares * steep.powi(3);
        let slanting = 3.0 * wavenumber_per_m * nearness * steep * reach_m;
        Self {
            weight: 2.0 * steep * spread(ranges_m[0]) * spread(ranges_m[1]),
            weight_derivatives,
            hessian,
            third,
            reach_m,
            bent_phase: [
                phase_of_height_per_m * along.rise_m,
                phase_of_height_per_m * along.third_m + slanting * along.rise_m,
            ],
            bent_weight: [w * along.turn, w * along.turn_second],
            phase_of_height_per_m,
        }
    }

    /// Bound on the second derivative of L₁ + L₂ along the plane: Σ (1 − d dᵀ)/L. Along the line of sight, as
    /// for roofs and kerbs, a length is linear. The direction d turns by reach/L over a tile; over a curved
    /// one the skin rises out of the plane, and is straight in no direction.
    fn length_hessian_per_m(field: &Field<'_>, x_m: DVec3, nearness_per_m: [f64; 2], reach_m: f64) -> DMat2 {
        let of = |image: Antenna, nearness_per_m: f64| {
            let along = field.frame.tangential(image.travel_direction_at(x_m));
            let straight = if field.node.bend.is_some() { 0.0 } else { 1.0 };
            let outer = straight * DMat2::from_cols(along.x * along, along.y * along);
            nearness_per_m * (DMat2::IDENTITY * (1.0 + straight * 2.0 * reach_m * nearness_per_m) - outer)
        };
        let [transmit, receive] = [field.node.transmit.image, field.node.receive.image];
        let there = of(transmit, nearness_per_m[0]);
        let back = if field.node.is_one_way() { there } else { of(receive, nearness_per_m[1]) };
        there + back
    }

    /// Root √(vᵀHv), rad^½.
    fn bend_along(&self, v: DVec2) -> f64 {
        of_form(v.dot(self.hessian * v)).sqrt()
    }

    /// Mean of |g − g(centre)| for g = weight·e^{jψ}, ψ the phase beyond its tangent plane at the centre: the
    /// mean distance from there is at most the root of its mean square, a half or a third of the reach.
    fn error_of_constant(&self, moments: &SecondMoment) -> f64 {
        let mean_square_m2 = moments.mean_square_m2();
        let phase = 0.5 * moments.mean_of(self.hessian) + self.third * self.reach_m / 6.0 * mean_square_m2;
        let bent = 0.5 * self.bent_phase[0] + self.bent_weight[0];
        self.weight * (phase + self.weight_derivatives[0] * mean_square_m2.sqrt() + bent)
    }

    /// Remainder of six-point interpolation: sup|D³g|·h³/6·Σ|x − xᵢ|³|ℓᵢ|/h³ (Ciarlet, Raviart 1972). It is
    /// invariant under affine maps, so that derivatives along the edges represent anisotropy: the phase's
    /// first two are measured by lengths √(vᵀHv), as |vᵀHx| ≤ √(vᵀHv)·√(xᵀHx).
    fn error_of_quadratic(&self, triangle_m: &[DVec2; 3], centre_m: DVec2) -> f64 {
        let (h, [w1, w2, w3]) = (longest_edge_m(triangle_m), self.weight_derivatives);
        let ([b2, b3], [v1, v2]) = (self.bent_phase, self.bent_weight);
        let along = edges_m(triangle_m).map(|edge| self.bend_along(edge)).into_iter().fold(0.0, f64::max);
        let reach =
            triangle_m.map(|corner| self.bend_along(corner - centre_m)).into_iter().fold(0.0, f64::max);
        let first = along * reach + 0.5 * self.third * self.reach_m * self.reach_m * h;
        let [p1, p2, p3] = [first + b2, along * along + b2, self.third * h * h * h + b3];
        let [w1, w2, w3] =
            [w1 * h + v1, w2 * h * h + v1 * v1 + v2, w3 * h * h * h + v1 * v1 * v1 + 3.0 * v1 * v2];
        let third_derivative =
            p1 * p1 * p1 + 3.0 * p1 * p2 + p3 + 3.0 * w1 * (p1 * p1 + p2) + 3.0 * w2 * p1 + w3;
        self.weight * third_derivative * SIX_POINT_REMAINDER
    }

    /// Edge along which the integrand varies most.
    fn worst_edge(&self, field: &Field<'_>, edges_m: &[DVec2; 3]) -> usize {
        // A tile as large as its distance from an antenna, or from the point straight below it, has no bound:
        // there the longest edge is halved, since any other would leave slivers without end.
        let squares = self.weight_derivatives[0].powi(2).min(UNBOUNDED);
        let bending = |edge: DVec2| self.bend_along(edge).powi(2).min(UNBOUNDED * edge.length_squared());
        let per_height = self.phase_of_height_per_m.min(UNBOUNDED);
        let change = edges_m.map(|edge| {
            let along = field.along([edge].into_iter());
            bending(edge)
                + squares * edge.length_squared()
                + per_height * along.rise_m
                + along.turn * along.turn
        });
        (0..3).fold(0, |most, i| if change[i] > change[most] { i } else { most })
    }
}

/// Value used for an infinite bound, rad/m²: beyond every wavelength, while its product with an edge is still
/// finite.
const UNBOUNDED: f64 = 1e100;

/// Supremum of Σ|x − xᵢ|³|ℓᵢ(x)|/6 over all triangles with longest edge 1 (scanned in the tests).
const SIX_POINT_REMAINDER: f64 = 0.025;

/// Mean of x xᵀ over a polygon relative to a centre, m².
struct SecondMoment(DMat2);

impl SecondMoment {
    /// Moments of each triangle about the centre, (a aᵀ + b bᵀ + (a bᵀ + b aᵀ)/2)/6; without area, from the
    /// extent of the corners.
    fn about(centre_m: DVec2, corners_m: &[DVec2]) -> Self {
        let outer = |a: DVec2, b: DVec2| DMat2::from_cols(b.x * a, b.y * a);
        let (mut area, mut moment) = (0.0, DMat2::ZERO);
        for (i, corner) in corners_m.iter().enumerate() {
            let (a, b) = (*corner - centre_m, corners_m[(i + 1) % corners_m.len()] - centre_m);
            let part = a.perp_dot(b);
            area += part;
            moment += part / 6.0 * (outer(a, a) + outer(b, b) + 0.5 * (outer(a, b) + outer(b, a)));
        }
        let mean = Self(moment * (1.0 / area));
        let at_most_m2 = reach_m(corners_m, centre_m).powi(2);
        let is_sound = area > 0.0 && (0.0..=at_most_m2).contains(&mean.mean_square_m2());
        if is_sound { mean } else { Self(DMat2::IDENTITY * at_most_m2) }
    }

    /// Mean of |x|².
    fn mean_square_m2(&self) -> f64 {
        self.0.x_axis.x + self.0.y_axis.y
    }

    /// Mean of xᵀHx, H symmetric.
    fn mean_of(&self, form: DMat2) -> f64 {
        of_form(form.x_axis.dot(self.0.x_axis) + form.y_axis.dot(self.0.y_axis))
    }
}

/// Value of a positive semidefinite form: negative values are rounding and become 0, infinite ones stay.
fn of_form(value: f64) -> f64 {
    if value.is_nan() { f64::INFINITY } else { value.max(0.0) }
}

fn reach_m(corners_m: &[DVec2], centre_m: DVec2) -> f64 {
    corners_m.iter().map(|c| c.distance_squared(centre_m)).fold(0.0, f64::max).sqrt()
}

fn edges_m(triangle_m: &[DVec2; 3]) -> [DVec2; 3] {
    [0, 1, 2].map(|i| triangle_m[(i + 1) % 3] - triangle_m[i])
}

fn longest_edge_m(triangle_m: &[DVec2; 3]) -> f64 {
    edges_m(triangle_m).map(DVec2::length).into_iter().fold(0.0, f64::max)
}

/// Both halves, divided at the midpoint of an edge.
fn halves(triangle_m: [DVec2; 3], edge: usize) -> [[DVec2; 3]; 2] {
    let [a, b, c] = [0, 1, 2].map(|i| triangle_m[(edge + i) % 3]);
    let middle = 0.5 * (a + b);
    [[a, middle, c], [middle, b, c]]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn remainder_of(triangle: [DVec2; 3]) -> f64 {
        let h = longest_edge_m(&triangle);
        let [a, b, c] = triangle;
        let points = [a, b, c, 0.5 * (b + c), 0.5 * (c + a), 0.5 * (a + b)];
        let n = 60;
        let mut worst = 0.0_f64;
        for i in 0..=n {
            for j in 0..=n - i {
                let (u, v) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
                let w = 1.0 - u - v;
                let x = u * a + v * b + w * c;
                let basis = [
                    u * (2.0 * u - 1.0),
                    v * (2.0 * v - 1.0),
                    w * (2.0 * w - 1.0),
                    4.0 * v * w,
                    4.0 * w * u,
                    4.0 * u * v,
                ];
                let sum: f64 = basis.iter().zip(points).map(|(l, p)| l.abs() * x.distance(p).powi(3)).sum();
                worst = worst.max(sum / 6.0 / h.powi(3));
            }
        }
        worst
    }

    #[test]
    fn the_remainder_constant_holds_for_triangles_of_every_shape() {
        let mut worst = 0.0_f64;
        for i in 0..=20 {
            for j in 0..=20 {
                // Third corner anywhere within one length of both ends of the longest edge.
                let c = DVec2::new(0.5 + f64::from(i) / 40.0, f64::from(j) / 20.0);
                if c.length() <= 1.0 && c.distance(DVec2::X) <= 1.0 {
                    worst = worst.max(remainder_of([DVec2::ZERO, DVec2::X, c]));
                }
            }
        }
        println!("largest remainder {worst:.5}, taken {SIX_POINT_REMAINDER}");
        assert!(worst <= SIX_POINT_REMAINDER && worst > 0.8 * SIX_POINT_REMAINDER);
    }
}
