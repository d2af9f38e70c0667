//! Terms of a flat polygon's corners, and of the parts of its sides along which the wave arrives at once:
//! the critical points of the third and second kind (Felsen, Marcuvitz 1973, ch. 4; James 1976, ch. 2), each
//! with its node.
//!
//! With L the length, g its gradient along the plane, c = g·t its slope along a side t with the outward
//! normal ν:
//!
//! ```text
//! corner: (j/k)² Σ ± w·(g·ν)/(|g|²c)·e^{−jkL}         side: (j/k) ∫ w·(g·ν)/|g|²·e^{−jkL} ds
//! ```
//! Points of a side are shared among nodes on it ([`crate::integral::interpolation`]). A corner's factor T
//! changes with g while a body moves. It gets a second node at a distance d along ∂T/∂g:
//!
//! ```text
//! T·e^{−jkL(x)} → (T − A)·e^{−jkL(x)} + A·e^{−jkL(x + d)},     A = (j/kd)·|∂T/∂g|
//! ```
//! This has the derivative ∂T/∂g by g, and errs by kd·δg²/2 of it, δg the change of g. With
//! d = |∂T/∂g|/(k|T|), where |A| = |T|, that is as little as the term's second derivative; d is at most 10/k.

use crate::integral::critical_points::{FarPolygon, Variation, halved};
use crate::integral::field::Field;
use crate::integral::interpolation::{DEGREE, NODES, cells_along, lagrange};
use crate::integral::node::Estimate;
use artifact::paths::Amplitude;
use glam::{DVec2, DVec3};
use num_complex::Complex64;

/// Second derivatives that a slope along a side may be divided by, of the side's own term and of its weight.
const ALONG_SIDE: f64 = 4.0;
/// Longest distance of a corner's second term, in radians of the middle frequency: a factor that is next to
/// zero changes by any multiple of itself.
const LONGEST_STEP: f64 = 10.0;
/// Minimum number of parts of a cell along a side, over which what is shared is linear.
const PARTS_OF_CELL: f64 = 8.0;

/// A term of a far part.
#[derive(Debug)]
pub(crate) struct CriticalPoint {
    /// Its node: a corner, or a point of a side.
    pub(crate) at_m: DVec3,
    /// Side of the part on which it lies, or at whose start, and its share of the side's length.
    pub(crate) side: usize,
    pub(crate) share: f64,
    /// Length of the side that it stands for; zero of a corner.
    pub(crate) length_m: f64,
    pub(crate) amplitudes: Estimate<Vec<Amplitude>>,
}

/// A term before it is weighed: integrals at every wavenumber.
struct Term {
    at_m: DVec2,
    length_m: f64,
    integrals_m2: Vec<Complex64>,
}

/// Factor of a corner, and its derivative by the length's gradient.
#[derive(Debug, Clone, Copy, Default)]
struct CornerFactor {
    value: f64,
    by_gradient: DVec2,
}

impl CornerFactor {
    /// (g·ν)/(|g|²c) of a point of a side.
    fn of_end(gradient: DVec2, side: &PolygonSide) -> Self {
        let (flux, square, slope) =
            (gradient.dot(side.outward()), gradient.length_squared(), gradient.dot(side.along));
        let by_others = 2.0 / square * gradient + side.along / slope;
        let by_gradient = (side.outward() - flux * by_others) / (square * slope);
        Self { value: flux / (square * slope), by_gradient }
    }

    /// Sum with another one times a weight.
    fn plus(self, weight: f64, other: Self) -> Self {
        Self {
            value: self.value + weight * other.value,
            by_gradient: self.by_gradient + weight * other.by_gradient,
        }
    }
}

/// A part of a side over which the phase is linear.
struct SidePart {
    middle_m: DVec2,
    half_m: f64,
    /// Change of the length from its middle to its end.
    half_turn_m: f64,
}

impl Field<'_> {
    /// Number of terms of a far part, with cells of some size on its sides.
    pub(crate) fn count_terms(&self, FarPolygon { corners_m, variation }: &FarPolygon, size_m: f64) -> f64 {
        let of_side = |side: PolygonSide| {
            let [from, to] = self.slow_span_m(&side, variation);
            if to > from { f64::from(cells_along(to - from, size_m) + 1) } else { 0.0 }
        };
        2.0 * corners_m.len() as f64 + sides(corners_m).map(of_side).sum::<f64>()
    }

    /// Calls `give` with the terms of a far part; nodes on sides are no more than `size_m` apart.
    pub(crate) fn for_each_term(
        &self,
        FarPolygon { corners_m, variation }: &FarPolygon,
        size_m: f64,
        wavenumbers_per_m: &[f64],
        give: &mut dyn FnMut(CriticalPoint),
    ) {
        let mut of_corners = vec![CornerFactor::default(); corners_m.len()];
        let mut give_all = |terms: &[Term], place: (usize, &dyn Fn(&Term) -> f64)| {
            for term in terms {
                let place = (place.0, place.1(term));
                give(self.critical_point(term, place, wavenumbers_per_m, variation.allowed));
            }
        };
        for (index, side) in sides(corners_m).enumerate() {
            let span_m = self.slow_span_m(&side, variation);
            let next = (index + 1) % corners_m.len();
            self.add_ends(&side, span_m, [index, next], &mut of_corners, &mut |at_m, factor| {
                let terms = self.terms_of_corner(at_m, factor, wavenumbers_per_m);
                give_all(&terms, (index, &|_| side.share_of(at_m)));
            });
            if span_m[1] > span_m[0] {
                let terms = self.terms_of_span(&side, span_m, size_m, variation, wavenumbers_per_m);
                give_all(&terms, (index, &|term| side.share_of(term.at_m)));
            }
        }
        let with_factors = corners_m.iter().zip(of_corners).enumerate();
        for (index, (corner_m, factor)) in with_factors.filter(|(_, (_, of))| of.value != 0.0) {
            give_all(&self.terms_of_corner(*corner_m, factor, wavenumbers_per_m), (index, &|_| 0.0));
        }
    }

    /// Factors at the ends of a side's steep parts: to its corners' sums, or, where a steep part ends on the
    /// side, to `give`.
    fn add_ends(
        &self,
        side: &PolygonSide,
        [from_m, to_m]: [f64; 2],
        corners: [usize; 2],
        of_corners: &mut [CornerFactor],
        give: &mut dyn FnMut(DVec2, CornerFactor),
    ) {
        let factor = |at_m: f64| CornerFactor::of_end(self.gradient_at(side.at(at_m)), side);
        let is_steep = from_m >= to_m;
        if is_steep || from_m > 0.0 {
            of_corners[corners[0]] = of_corners[corners[0]].plus(1.0, factor(0.0));
        }
        if is_steep || to_m < side.length_m {
            of_corners[corners[1]] = of_corners[corners[1]].plus(-1.0, factor(side.length_m));
        }
        if !is_steep && from_m > 0.0 {
            give(side.at(from_m), CornerFactor::default().plus(-1.0, factor(from_m)));
        }
        if !is_steep && to_m < side.length_m {
            give(side.at(to_m), factor(to_m));
        }
    }

    /// Terms of a corner: its own, and the one that follows its change.
    fn terms_of_corner(&self, at_m: DVec2, factor: CornerFactor, wavenumbers_per_m: &[f64]) -> [Term; 2] {
        let middle_per_m = wavenumbers_per_m[wavenumbers_per_m.len() / 2];
        let (value, change) = (factor.value, factor.by_gradient.length());
        let step_m = (change / value.abs()).min(LONGEST_STEP) / middle_per_m;
        let second_m = at_m + step_m * factor.by_gradient.normalize_or_zero();
        let world_m = |at_m: DVec2| self.frame.to_world(at_m);
        let further_m = self.length_m(world_m(second_m)) - self.length_m(world_m(at_m));
        let term = |at_m: DVec2, of: &dyn Fn(f64) -> Complex64| Term {
            at_m,
            length_m: 0.0,
            integrals_m2: wavenumbers_per_m.iter().map(|k| of(*k) / (k * k)).collect(),
        };
        let follows = |k: f64| Complex64::new(0.0, if step_m > 0.0 { change / (k * step_m) } else { 0.0 });
        [term(at_m, &|k| value - follows(k)), term(second_m, &|k| follows(k) * Complex64::cis(k * further_m))]
    }

    /// Factor (g·ν)/|g|² of a point of a side.
    fn side_factor(&self, side: &PolygonSide, at_m: f64) -> f64 {
        let gradient = self.gradient_at(side.at(at_m));
        gradient.dot(side.outward()) / gradient.length_squared()
    }

    /// Slope of the length along a side.
    fn slope(&self, side: &PolygonSide, at_m: f64) -> f64 {
        self.gradient_at(side.at(at_m)).dot(side.along)
    }

    /// Interval of a side where its slope is less than it has to be; empty where there is none.
    fn slow_span_m(&self, side: &PolygonSide, variation: &Variation) -> [f64; 2] {
        let least = variation.least_gradient(ALONG_SIDE);
        let [first, last] = [0.0, side.length_m].map(|at_m| self.slope(side, at_m));
        if first >= least || last <= -least {
            return [0.0; 2];
        }
        let root_m = |offset: f64| root_m(side, |at_m| self.slope(side, at_m) + offset);
        let from_m = if first > -least { 0.0 } else { root_m(least) };
        let to_m = if last < least { side.length_m } else { root_m(-least) };
        [from_m, to_m]
    }

    /// Terms of nodes along a span of a side, among which its points are shared.
    fn terms_of_span(
        &self,
        side: &PolygonSide,
        [from_m, to_m]: [f64; 2],
        size_m: f64,
        variation: &Variation,
        wavenumbers_per_m: &[f64],
    ) -> Vec<Term> {
        let cells = cells_along(to_m - from_m, size_m);
        let cell_m = (to_m - from_m) / f64::from(cells);
        let node = |i: u32| Term {
            at_m: side.at(from_m + f64::from(i) * cell_m),
            length_m: cell_m,
            integrals_m2: vec![Complex64::ZERO; wavenumbers_per_m.len()],
        };
        let mut terms: Vec<Term> = (0..=cells).map(node).collect();
        let parts = (cell_m / variation.longest_m()).ceil().max(PARTS_OF_CELL) as u32;
        let half_m = 0.5 * cell_m / f64::from(parts);
        for i in 0..cells * parts {
            let middle_m = from_m + f64::from(2 * i + 1) * half_m;
            let first_node = i / parts / DEGREE * DEGREE;
            let place = |at_m: f64| (at_m - from_m) / cell_m - f64::from(first_node);
            let ends_m = [middle_m - half_m, middle_m + half_m];
            let ends = ends_m.map(|at_m| (self.side_factor(side, at_m), lagrange(place(at_m))));
            let half_turn_m = half_m * self.slope(side, middle_m);
            let part = SidePart { middle_m: side.at(middle_m), half_m, half_turn_m };
            for (index, term) in terms[first_node as usize..].iter_mut().take(NODES).enumerate() {
                let factors = ends.map(|(factor, shares)| factor * shares[index]);
                self.add_part(term, &part, factors, wavenumbers_per_m);
            }
        }
        terms
    }

    /// Adds a part of a side to a term, with factors at its ends, between which they are linear.
    fn add_part(&self, term: &mut Term, part: &SidePart, [first, last]: [f64; 2], wavenumbers_per_m: &[f64]) {
        let length_m = |at_m: DVec2| self.length_m(self.frame.to_world(at_m));
        let further_m = length_m(part.middle_m) - length_m(term.at_m);
        let linear = [0.5 * (first + last), 0.5 * (last - first) / part.half_m];
        for (sum, k) in term.integrals_m2.iter_mut().zip(wavenumbers_per_m) {
            let turn = Complex64::i() / k * Complex64::cis(-k * further_m);
            *sum += turn * linear_m(linear, part.half_m, k * part.half_turn_m);
        }
    }

    /// A term weighed at its node.
    fn critical_point(
        &self,
        term: &Term,
        (side, share): (usize, f64),
        wavenumbers_per_m: &[f64],
        allowed: f64,
    ) -> CriticalPoint {
        let at_m = self.frame.to_world(term.at_m);
        let of_node = Field::new(self.node, at_m, self.accuracy);
        let integrals_m2: Vec<[Complex64; 1]> = term.integrals_m2.iter().map(|of| [*of]).collect();
        let value = of_node.amplitudes_of(&[of_node.surface_about(at_m)], wavenumbers_per_m, &integrals_m2);
        let largest = value.iter().flatten().flatten().map(|a| a.norm()).fold(0.0, f64::max);
        CriticalPoint {
            at_m,
            side,
            share,
            length_m: term.length_m,
            amplitudes: Estimate { value, error: allowed * largest },
        }
    }
}

/// Integral of (w₀ + w₁s)·e^{−jus/a} over s from −a to a.
fn linear_m([middle, slope]: [f64; 2], half_m: f64, half_turn: f64) -> Complex64 {
    // (sin u/u − cos u)/u = u/3 − u³/30 + …
    let (even, odd) = if half_turn.abs() < 1e-3 {
        (1.0 - half_turn * half_turn / 6.0, half_turn / 3.0)
    } else {
        let (sin, cos) = half_turn.sin_cos();
        (sin / half_turn, (sin / half_turn - cos) / half_turn)
    };
    2.0 * half_m * Complex64::new(middle * even, -half_m * slope * odd)
}

/// A side of a polygon in its plane.
struct PolygonSide {
    start_m: DVec2,
    along: DVec2,
    length_m: f64,
}

impl PolygonSide {
    fn at(&self, at_m: f64) -> DVec2 {
        self.start_m + at_m * self.along
    }

    /// Share of its length up to a point on it.
    fn share_of(&self, at_m: DVec2) -> f64 {
        self.start_m.distance(at_m) / self.length_m
    }

    fn outward(&self) -> DVec2 {
        -self.along.perp()
    }
}

fn sides(corners_m: &[DVec2]) -> impl Iterator<Item = PolygonSide> {
    let ends = corners_m.iter().copied().zip(corners_m.iter().copied().cycle().skip(1));
    let of = |(start_m, end_m): (DVec2, DVec2)| {
        let length_m = start_m.distance(end_m);
        PolygonSide { start_m, along: (end_m - start_m) / length_m, length_m }
    };
    ends.map(of)
}

/// Place on a side where a function that grows along it is zero.
fn root_m(side: &PolygonSide, of: impl Fn(f64) -> f64) -> f64 {
    const HALVINGS: u32 = 40;
    let [low, high] = halved([0.0, side.length_m], HALVINGS, |at_m| of(at_m) > 0.0);
    0.5 * (low + high)
}
