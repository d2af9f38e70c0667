//! Closed forms of the integral of a phase over a flat convex polygon.

use crate::integral::divided_difference::{DividedDifferences, second_moments};
use crate::integral::phasors::{Phasors, SHORT, WAVENUMBERS_PER_BATCH, phasors, short_phasor, short_sinc};
use glam::DVec2;
use num_complex::Complex64;

/// Product of phase gradient and width below which the moment series replaces Gordon's formula: every term of
/// its sum is rounded at ε·D/|w|, the integral is of the order of the area A = D·width, so the relative loss
/// is ε/(|w|·width): 2e-14 here. (For a body as wide as long this is the ε/(|w|D) of physics.md §1; a needle
/// loses more, by its aspect ratio.)
const SERIES_BELOW: f64 = 1e-2;

/// Integral I = ∫_P e^{−jkg·x} dA at the first [`WAVENUMBERS_PER_BATCH`] of the wavenumbers k, P the convex
/// polygon `corners_m`, counter-clockwise, and g the `gradient` of a length.
///
/// Gordon (1975): Stokes' theorem turns the integral into a sum over edges, with w = −kg I = (−j/|w|²) Σ
/// (w·(e × n)) ∫₀¹ e^{jw·(a + te)} dt with edges e from corners a. An edge along the wavefront needs no
/// special case; only a vanishing |w|·width does, where all moments of the polygon are summed to rounding.
/// The phase is that of the coordinates' origin, which should lie in or near the polygon. Error: 1e-13 of the
/// area.
pub(crate) fn linear_phase_integrals(
    corners_m: &[DVec2],
    gradient: DVec2,
    wavenumbers_per_m: &[f64],
) -> Phasors {
    let width = gradient.length() * width_m(corners_m);
    let mut integrals_m2 = gordon(corners_m, gradient, wavenumbers_per_m);
    for (integral, k) in
        integrals_m2.iter_mut().zip(wavenumbers_per_m).filter(|(_, k)| *k * width < SERIES_BELOW)
    {
        *integral = moment_series(corners_m, -k * gradient);
    }
    integrals_m2
}

/// Weights W of the six values of a function g at a triangle's corners and edge midpoints (opposite to the
/// corners) such that ∫ g e^{jφ} dA = A Σ W_i g_i, exactly for every g of second degree; `phases` are those
/// of the linear φ at the corners, `phasors` their e^{jφ}.
///
/// With g in Bernstein form (corner values, and 2g(midpoint) minus the mean of the two corners) each term is
/// one divided difference with five points.
pub(crate) fn six_point_weights(phases: [f64; 3], turns: [Complex64; 3]) -> [Complex64; 6] {
    let [s0, s1, s2, p0, p1, p2] = second_moments(phases, turns);
    let (squares, products) = ([s0, s1, s2], [p0, p1, p2]);
    let all: Complex64 = products.iter().sum();
    let corner = |i: usize| 4.0 * squares[i] - 2.0 * (all - products[i]);
    let middle = |i: usize| 8.0 * products[i];
    [corner(0), corner(1), corner(2), middle(0), middle(1), middle(2)]
}

fn gordon(corners_m: &[DVec2], gradient: DVec2, wavenumbers_per_m: &[f64]) -> Phasors {
    let mut sums = [Complex64::ZERO; WAVENUMBERS_PER_BATCH];
    let first_m = gradient.dot(corners_m[0]);
    let first = phasors(first_m, wavenumbers_per_m);
    let (mut from_m, mut from) = (first_m, first);
    for (i, (start, end)) in edges(corners_m).enumerate() {
        let last = i + 1 == corners_m.len();
        let to_m = if last { first_m } else { gradient.dot(end) };
        let to = if last { first } else { phasors(to_m, wavenumbers_per_m) };
        let flux_m = gradient.perp_dot(end - start);
        for (n, k) in wavenumbers_per_m.iter().take(WAVENUMBERS_PER_BATCH).enumerate() {
            sums[n] += flux_m * along_edge(k * (from_m - to_m), from[n], to[n]);
        }
        (from_m, from) = (to_m, to);
    }
    for (sum, k) in sums.iter_mut().zip(wavenumbers_per_m) {
        *sum = Complex64::new(-sum.im, sum.re) / (k * gradient.length_squared());
    }
    sums
}

/// Integral ∫₀¹ e^{j(φ + tΔ)} dt from e^{jφ} and e^{j(φ + Δ)}.
fn along_edge(further: f64, from: Complex64, to: Complex64) -> Complex64 {
    let half = 0.5 * further;
    if half.abs() <= SHORT {
        from * short_phasor(half) * short_sinc(half)
    } else {
        let difference = to - from;
        Complex64::new(difference.im, -difference.re) / further
    }
}

/// Sum over triangles around the first corner; the divided difference of each sums its moments of all orders.
fn moment_series(corners_m: &[DVec2], gradient_per_m: DVec2) -> Complex64 {
    let first = corners_m[0];
    corners_m[1..]
        .windows(2)
        .map(|pair| {
            let doubled_area = (pair[0] - first).perp_dot(pair[1] - first);
            let phases = [first, pair[0], pair[1]].map(|corner| gradient_per_m.dot(corner));
            DividedDifferences::new(phases).of([1; 3]) * doubled_area
        })
        .sum()
}

fn edges(corners_m: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> {
    corners_m.iter().copied().zip(corners_m.iter().copied().cycle().skip(1))
}

/// Area over the greatest distance from the first corner: the width within a factor of two.
fn width_m(corners_m: &[DVec2]) -> f64 {
    let first = corners_m[0];
    let length = corners_m.iter().map(|c| c.distance_squared(first)).fold(0.0, f64::max).sqrt();
    let area: f64 = corners_m[1..].windows(2).map(|p| 0.5 * (p[0] - first).perp_dot(p[1] - first)).sum();
    if length > 0.0 { area / length } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn linear_phase_integral(corners_m: &[DVec2], gradient_per_m: DVec2) -> Complex64 {
        linear_phase_integrals(corners_m, -gradient_per_m, &[1.0])[0]
    }

    fn disc_polygon(sides: u32, stretch: f64) -> Vec<DVec2> {
        (0..sides)
            .map(|i| {
                DVec2::from_angle(std::f64::consts::TAU * f64::from(i) / f64::from(sides))
                    * DVec2::new(1.0, stretch)
            })
            .collect()
    }

    fn fan(corners_m: &[DVec2], gradient_per_m: DVec2) -> Complex64 {
        moment_series(corners_m, gradient_per_m)
    }

    /// P8: Gordon's sum over edges and the sum of triangles are different closed forms of the same integral.
    #[test]
    fn gordons_edges_equal_the_sum_of_triangles_from_1e_minus_9_to_1e3() {
        let mut worst = 0.0_f64;
        for (sides, stretch) in [(3, 1.0), (4, 1.0), (7, 0.3), (5, 1e-6)] {
            let corners = disc_polygon(sides, stretch);
            let area = fan(&corners, DVec2::ZERO).re;
            for exponent in -9..=3 {
                for angle in [0.0, 0.1, 0.7, 2.0] {
                    let gradient = DVec2::from_angle(angle) * 10_f64.powi(exponent);
                    let difference = linear_phase_integral(&corners, gradient) - fan(&corners, gradient);
                    worst = worst.max(difference.norm() / area);
                }
            }
        }
        // Gordon's loss just above the switch, 2e-14 for each of up to 7 edges with independent rounding
        // errors.
        println!("asked 1e-13 of the area, got {worst:.1e}");
        assert!(worst < 1e-13);
    }

    #[test]
    fn an_edge_along_the_wavefront_is_no_special_case() {
        let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        let w = 37.0;
        let exact = (Complex64::cis(w) - 1.0) / Complex64::new(0.0, w);
        assert!((linear_phase_integral(&square, DVec2::new(w, 0.0)) - exact).norm() < 1e-15);
        assert!((linear_phase_integral(&square, DVec2::new(w, 1e-13)) - exact).norm() < 1e-13);
    }

    #[test]
    fn several_wavenumbers_together_are_each_for_itself() {
        let corners = disc_polygon(5, 0.4);
        let wavenumbers_per_m: Vec<f64> = (0..12).map(|i| 1603.0 + f64::from(i)).collect();
        for exponent in -7..=0 {
            let gradient = DVec2::new(0.6, -0.8) * 10_f64.powi(exponent);
            let together = linear_phase_integrals(&corners, gradient, &wavenumbers_per_m);
            for (integral, k) in together.iter().zip(&wavenumbers_per_m) {
                let error = (integral - linear_phase_integral(&corners, -k * gradient)).norm();
                // Phases of up to k radians are rounded.
                assert!(error < 1e-13, "{exponent} {k}: {error:e}");
            }
        }
    }

    #[test]
    fn six_points_integrate_every_quadratic_under_a_linear_phase() {
        let phases = [0.3, 40.0, -7.0];
        let weights = six_point_weights(phases, phases.map(Complex64::cis));
        let (nodes, gauss) = crate::integral::test_quadrature::gauss_legendre(60);
        let quadratic = |l: [f64; 3]| 1.0 + l[0] - 3.0 * l[1] * l[2] + 2.0 * l[2] * l[2];
        let mut exact = Complex64::ZERO;
        for (u, wu) in nodes.iter().zip(&gauss) {
            for (v, wv) in nodes.iter().zip(&gauss) {
                let (s, t) = (0.5 * (u + 1.0), 0.5 * (v + 1.0));
                let l = [1.0 - s, s * (1.0 - t), s * t];
                let phase = l[0] * phases[0] + l[1] * phases[1] + l[2] * phases[2];
                // A = 1: the unit square maps onto the triangle with the Jacobian 2s.
                exact += Complex64::cis(phase) * (0.25 * wu * wv * 2.0 * s * quadratic(l));
            }
        }
        let at = [
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.5, 0.5],
            [0.5, 0.0, 0.5],
            [0.5, 0.5, 0.0],
        ];
        let got: Complex64 = weights.iter().zip(at).map(|(w, l)| w * quadratic(l)).sum();
        assert!((got - exact).norm() < 1e-14, "{:e}", (got - exact).norm());
    }
}
