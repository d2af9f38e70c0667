//! A flat polygon's part about the point where its phase is stationary, and the parts far from it.
//!
//! With L the length, g its gradient along the plane, c = g·t its slope along a side t with the outward
//! normal ν, integration by parts (the divergence theorem, twice) leaves the critical points of the second
//! and third kind (Felsen, Marcuvitz 1973, ch. 4; James 1976, ch. 2):
//!
//! ```text
//! ∫ w·e^{−jkL} dA = (j/k) ∮ w·(g·ν)/|g|² · e^{−jkL} ds + …,   |…| ≤ ∫ (h/k|g|² + |w′|/k|g|)
//! ∫ w·(g·ν)/|g|² · e^{−jkL} ds = [(j/k) w·(g·ν)/(|g|²c) · e^{−jkL}] + …
//! ```
//! h ≥ ‖∇∇L‖ is Σ 1/Lᵢ of the nearest point, and L is convex: what is left out falls with the distance from
//! the stationary point, so one rectangle about it holds all of the plane where it is more than is allowed.
//! There the polygon is integrated as ever; the rest are terms of corners and sides
//! ([`crate::integral::critical_points::terms`]).
//!
//! A side off its specular has next to no echo of its own, and that little comes from its corners. As cells,
//! each with the phase of its middle, it is a difference of thousands of terms that are each stronger than
//! all of it, and no size of cells follows how it changes in a frame; as corners it is a few terms whose
//! phases are exact.

pub(crate) mod terms; // terms of the corners and sides of far parts

use crate::geometry::antenna::Antenna;
use crate::geometry::convex_intersection::left_of;
use crate::geometry::plane_frame::{area_m2, centroid_m};
use crate::integral::field::Field;
use glam::DVec2;

/// A polygon's parts about the point where its phase is stationary and far from it, all convex.
#[derive(Debug, Default)]
pub(crate) struct SplitPolygon {
    pub(crate) near: Vec<Vec<DVec2>>,
    pub(crate) far: Vec<FarPolygon>,
}

/// A part that is told by terms of its corners and sides.
#[derive(Debug)]
pub(crate) struct FarPolygon {
    pub(super) corners_m: Vec<DVec2>,
    pub(super) variation: Variation,
}

impl FarPolygon {
    /// Corners at both ends of a side.
    pub(crate) fn ends_of(&self, side: usize) -> [DVec2; 2] {
        [side, side + 1].map(|corner| self.corners_m[corner % self.corners_m.len()])
    }
}

/// Bounds of what varies over a polygon, and of what may be left out.
#[derive(Debug)]
pub(super) struct Variation {
    /// Bound h of the second derivatives of the length, 1/m.
    second_per_m: f64,
    /// Bound of the weight's relative derivative, 1/m.
    weight_per_m: f64,
    wavenumber_per_m: f64,
    /// Share of a term that may be left out beside it.
    pub(super) allowed: f64,
}

/// Largest share of a term that is left out beside it, however coarse an integral may be.
pub(crate) const COARSEST: f64 = 0.01;

impl Variation {
    /// `None` where an antenna is straight above, where polarizations turn without limit.
    fn over(
        field: &Field<'_>,
        corners_m: &[DVec2],
        heights_m: [f64; 2],
        wavenumber_per_m: f64,
    ) -> Option<Self> {
        let centre_m = centroid_m(corners_m);
        let x_m = field.frame.to_world(centre_m);
        let reach_m = corners_m.iter().map(|c| c.distance(centre_m)).fold(0.0, f64::max);
        let nearest_m =
            field.ranges_m(x_m).into_iter().zip(heights_m).map(|(l, height)| (l - reach_m).max(height));
        let second_per_m = nearest_m.map(f64::recip).sum::<f64>();
        let weight_per_m = field.weight_turns(wavenumber_per_m)[0] * field.turning_per_m(x_m, reach_m);
        let allowed = field.accuracy.clamp(f64::EPSILON, COARSEST);
        let of = Self { second_per_m, weight_per_m, wavenumber_per_m, allowed };
        (second_per_m + weight_per_m).is_finite().then_some(of)
    }

    /// Least gradient g with (n·h/g² + w/g)/k as small as is allowed.
    pub(super) fn least_gradient(&self, seconds: f64) -> f64 {
        let scale = self.wavenumber_per_m * self.allowed;
        let root = (self.weight_per_m.powi(2) + 4.0 * seconds * self.second_per_m * scale).sqrt();
        0.5 * (self.weight_per_m + root) / scale
    }

    /// Longest piece of a side over which the phase is as good as linear: kh·l²/8 is the error.
    pub(super) fn longest_m(&self) -> f64 {
        (8.0 * self.allowed / (self.wavenumber_per_m * self.second_per_m)).sqrt()
    }
}

/// Heights of both antennas above the plane; `None` of one infinitely far away.
fn heights_m(field: &Field<'_>) -> Option<[f64; 2]> {
    let of = |antenna: Antenna| match antenna {
        Antenna::Point(p) => Some((p - field.frame.to_world(DVec2::ZERO)).dot(field.node.normal).abs()),
        Antenna::Direction(_) => None,
    };
    let [there, back] = field.of_both(|leg| leg.image).map(of);
    Some([there?, back?])
}

impl Field<'_> {
    pub(super) fn gradient_at(&self, plane_m: DVec2) -> DVec2 {
        self.length_gradient(&self.surface_at(plane_m))
    }

    /// Point of the plane where the length is stationary: it parts the feet of both antennas as their
    /// heights.
    fn stationary_m(&self, heights_m: [f64; 2]) -> DVec2 {
        let foot_m = |antenna: Antenna| match antenna {
            Antenna::Point(p) => self.frame.plane_from_world(p),
            Antenna::Direction(_) => DVec2::ZERO,
        };
        let [there, back] = self.of_both(|leg| leg.image).map(foot_m);
        let sum_m = heights_m[0] + heights_m[1];
        there.lerp(back, if sum_m > 0.0 { heights_m[0] / sum_m } else { 0.5 })
    }

    /// The part of a polygon about the stationary point, and the parts where terms of corners and sides tell
    /// the integral to the field's accuracy; all of a bent one is near.
    pub(crate) fn split_about_stationary_point(
        &self,
        corners_m: &[DVec2],
        wavenumber_per_m: f64,
    ) -> SplitPolygon {
        let all_near = || SplitPolygon { near: vec![corners_m.to_vec()], far: vec![] };
        let Some(heights_m) = heights_m(self).filter(|_| !self.is_bent()) else { return all_near() };
        let variation_over = |part: &[DVec2]| Variation::over(self, part, heights_m, wavenumber_per_m);
        let Some(variation) = variation_over(corners_m) else { return all_near() };
        let stationary_m = self.stationary_m(heights_m);
        let farthest_m = corners_m.iter().map(|c| c.distance(stationary_m)).fold(0.0, f64::max);
        let least = variation.least_gradient(1.0);
        let Some(radius_m) = self.radius_m(stationary_m, least, farthest_m) else { return all_near() };
        let [about, around] = cut_about(corners_m, stationary_m, radius_m);
        let mut parted = SplitPolygon { near: about, far: vec![] };
        for part in around {
            // The disc about a long strip may reach to where that of the whole does not.
            match variation_over(&part) {
                Some(variation) => parted.far.push(FarPolygon { corners_m: distinct(&part), variation }),
                None => parted.near.push(part),
            }
        }
        parted
    }

    /// Distance from the stationary point, below `farthest_m`, from which on the gradient is no smaller than
    /// some: along a ray it only grows.
    fn radius_m(&self, stationary_m: DVec2, least: f64, farthest_m: f64) -> Option<f64> {
        const RAYS: u32 = 16;
        const HALVINGS: u32 = 12;
        let rays =
            (0..RAYS).map(|i| DVec2::from_angle(std::f64::consts::TAU * f64::from(i) / f64::from(RAYS)));
        let slopes =
            |radius_m: f64| rays.clone().map(move |r| self.gradient_at(stationary_m + radius_m * r).dot(r));
        let is_steep = |radius_m: f64| slopes(radius_m).all(|slope| slope >= least);
        if !is_steep(farthest_m) {
            return None;
        }
        Some(halved([0.0, farthest_m], HALVINGS, is_steep)[1])
    }

    /// Number of terms and cells of some size that a polygon takes.
    pub(crate) fn count_split(&self, corners_m: &[DVec2], size_m: f64, wavenumber_per_m: f64) -> f64 {
        let SplitPolygon { near, far } = self.split_about_stationary_point(corners_m, wavenumber_per_m);
        let of_near = |polygon: &Vec<DVec2>| (area_m2(polygon) / (size_m * size_m)).max(1.0);
        near.iter().map(of_near).sum::<f64>()
            + far.iter().map(|far| self.count_terms(far, size_m)).sum::<f64>()
    }
}

/// Corners without those that lie on the one before.
fn distinct(corners_m: &[DVec2]) -> Vec<DVec2> {
    let mut corners_m = corners_m.to_vec();
    corners_m.dedup();
    if corners_m.len() > 1 && corners_m.first() == corners_m.last() {
        corners_m.pop();
    }
    corners_m
}

/// A span halved so often about the place from which on something holds.
pub(super) fn halved(span: [f64; 2], halvings: u32, holds: impl Fn(f64) -> bool) -> [f64; 2] {
    (0..halvings).fold(span, |[low, high], _| {
        let middle = 0.5 * (low + high);
        if holds(middle) { [low, middle] } else { [middle, high] }
    })
}

/// The square of a half side about a point, and what is left of a polygon around it.
fn cut_about(corners_m: &[DVec2], centre_m: DVec2, half_m: f64) -> [Vec<Vec<DVec2>>; 2] {
    let (mut around, mut rest) = (vec![], corners_m.to_vec());
    for out in [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y] {
        let line_m = centre_m + half_m * out;
        around.push(left_of(&rest, line_m, -out.perp()));
        rest = left_of(&rest, line_m, out.perp());
    }
    [vec![rest], around].map(|mut parts| {
        parts.retain(|part| area_m2(part) > 0.0);
        parts
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::leg_surfaces::LegSurfaces;
    use crate::integral::node::{Bracket, Leg, Node};
    use crate::integral::polarization::Mirrors;
    use crate::integral::test_quadrature::gauss_legendre;
    use glam::DVec3;
    use num_complex::Complex64;

    const WAVENUMBER_PER_M: f64 = std::f64::consts::TAU * 77e9 / artifact::units::SPEED_OF_LIGHT_MPS;

    fn leg(antenna_m: [f64; 3]) -> Leg {
        Leg {
            image: Antenna::Point(DVec3::from_array(antenna_m)),
            mirrors: Mirrors::NONE,
            steps: LegSurfaces::default(),
            zenith_h: DVec3::Y,
        }
    }

    /// A quadrilateral in the plane x = 0 and two antennas before it.
    struct Case {
        name: &'static str,
        corners_m: [[f64; 2]; 4],
        antennas_m: [[f64; 3]; 2],
    }

    impl Case {
        fn with_node<T>(&self, of: impl FnOnce(&Node<'_>) -> T) -> T {
            let [transmit, receive] = self.antennas_m.map(leg);
            let corners_m = self.corners_m.map(|[y, z]| DVec3::new(0.0, y, z));
            let (normal, bend, material, bracket) = (DVec3::X, None, None, Bracket::Symmetrised);
            let (transmit, receive) = (&transmit, &receive);
            of(&Node { corners_m: &corners_m, normal, bend, material, transmit, receive, bracket })
        }

        /// The same with antennas so many times as far away.
        fn seen_from_afar(&self, times: f64) -> Self {
            Self { antennas_m: self.antennas_m.map(|at_m| at_m.map(|x| times * x)), ..*self }
        }

        fn by_quadrature(&self) -> Complex64 {
            self.with_node(|node| {
                let field = Field::new(node, DVec3::ZERO, 1.0);
                let corners_m = node.corners_m.iter().map(|c| field.frame.plane_from_world(*c));
                by_quadrature(&field, &corners_m.collect::<Vec<_>>())
            })
        }

        /// The integral as of the origin, sides in pieces of 2 cm.
        fn by_parts(&self, accuracy: f64) -> Sums {
            self.with_node(|node| {
                let field = Field::new(node, DVec3::ZERO, accuracy);
                let polygon: Vec<DVec2> =
                    node.corners_m.iter().map(|c| field.frame.plane_from_world(*c)).collect();
                let parted = field.split_about_stationary_point(&polygon, WAVENUMBER_PER_M);
                let (mut terms, mut strongest) = (0, 0.0_f64);
                let mut sum = Complex64::ZERO;
                for far in &parted.far {
                    field.for_each_term(far, 0.02, &[WAVENUMBER_PER_M], &mut |part| {
                        terms += 1;
                        let turn = Complex64::cis(-WAVENUMBER_PER_M * field.length_m(part.at_m));
                        let spread: f64 = field.spread(part.at_m).iter().product();
                        let amplitude = part.amplitudes.value[0][1][1];
                        strongest = strongest.max(amplitude.norm());
                        sum += spread * turn * amplitude;
                    });
                }
                let of_near: Complex64 = parted.near.iter().map(|near| by_quadrature(&field, near)).sum();
                Sums { by_parts: sum + of_near, strongest, terms, near: parted.near.len() }
            })
        }
    }

    /// Amplitudes hh of a polygon, with the strongest term and counts.
    struct Sums {
        by_parts: Complex64,
        strongest: f64,
        terms: usize,
        near: usize,
    }

    /// Amplitude hh of a polygon, point by point.
    fn by_quadrature(field: &Field<'_>, corners_m: &[DVec2]) -> Complex64 {
        let (nodes, weights) = gauss_legendre(500);
        let mut sum = Complex64::ZERO;
        for pair in corners_m[1..].windows(2) {
            let [a, b, c] = [corners_m[0], pair[0], pair[1]];
            let doubled_area_m2 = (b - a).perp_dot(c - a);
            for (u, wu) in nodes.iter().zip(&weights) {
                for (v, wv) in nodes.iter().zip(&weights) {
                    let (s, t) = (0.5 * (u + 1.0), 0.5 * (v + 1.0));
                    let at = field.surface_at(a + s * (b.lerp(c, t) - a));
                    let turn = Complex64::cis(-WAVENUMBER_PER_M * field.length_m(at.x_m));
                    sum += 0.25 * wu * wv * s * doubled_area_m2 * field.weights(&at)[3] * turn;
                }
            }
        }
        Complex64::i() * WAVENUMBER_PER_M / std::f64::consts::PI.sqrt() * sum
    }

    const SIDE_M: [[f64; 2]; 4] = [[-0.2, -0.1], [0.25, -0.1], [0.25, 0.08], [-0.2, 0.08]];
    const CASES: [Case; 6] = [
        Case { name: "oblique", corners_m: SIDE_M, antennas_m: [[1.2, 0.9, 0.4]; 2] },
        Case { name: "side along the wave", corners_m: SIDE_M, antennas_m: [[1.2, 0.03, 0.9]; 2] },
        Case { name: "specular on it", corners_m: SIDE_M, antennas_m: [[2.0, 0.04, 0.01]; 2] },
        Case { name: "specular at its side", corners_m: SIDE_M, antennas_m: [[1.5, 0.3, 0.03]; 2] },
        Case {
            name: "bistatic, of no right angles",
            corners_m: [[-0.15, -0.09], [0.14, -0.12], [0.2, 0.07], [-0.08, 0.11]],
            antennas_m: [[1.4, 0.8, 0.2], [0.9, 0.3, -0.6]],
        },
        Case { name: "nearly along it", corners_m: SIDE_M, antennas_m: [[0.1, 2.1, 0.2]; 2] },
    ];

    /// Errors are told beside the strongest term: of four corners little may be left.
    #[test]
    fn corners_and_sides_are_the_integral_to_the_accuracy_asked() {
        for case in CASES.iter().flat_map(|case| [1.0, 10.0].map(|times| case.seen_from_afar(times))) {
            let exact = case.by_quadrature();
            for accuracy in [1e-2, 3e-3, 1e-3, 1e-4] {
                let Sums { by_parts, strongest, terms, near } = case.by_parts(accuracy);
                let error = (by_parts - exact).norm() / strongest.max(exact.norm());
                println!("{}: asked {accuracy:.0e}, got {error:.1e}, {terms} terms, {near} near", case.name);
                assert!(error <= accuracy, "{}: asked {accuracy:e}, got {error:e}", case.name);
            }
        }
    }

    #[test]
    fn a_polygon_far_from_its_specular_is_its_four_corners() {
        let sums = CASES[0].seen_from_afar(10.0).by_parts(1e-2);
        // Two terms a corner.
        assert_eq!((sums.terms, sums.near), (8, 0));
    }

    #[test]
    fn an_antenna_infinitely_far_away_or_straight_above_leaves_all_to_be_integrated() {
        let overhead = Case { name: "overhead", corners_m: SIDE_M, antennas_m: [[0.0, 0.0, 9.0]; 2] };
        overhead.with_node(|node| {
            let field = Field::new(node, DVec3::ZERO, 1e-2);
            let polygon = [DVec2::ZERO, DVec2::X, DVec2::Y];
            assert!(field.split_about_stationary_point(&polygon, WAVENUMBER_PER_M).far.is_empty());
        });
        let far = Leg { image: Antenna::Direction(DVec3::new(0.8, 0.6, 0.0)), ..leg([1.0, 0.0, 0.0]) };
        CASES[0].with_node(|node| {
            let node = Node { transmit: &far, receive: &far, ..*node };
            let field = Field::new(&node, DVec3::ZERO, 1e-2);
            let polygon = [DVec2::ZERO, DVec2::X, DVec2::Y];
            assert_eq!(
                field.split_about_stationary_point(&polygon, WAVENUMBER_PER_M).near,
                [polygon.to_vec()]
            );
        });
    }
}
