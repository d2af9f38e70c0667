//! Fresnel integral in the form of edge waves, the Faddeeva function on a diagonal: W(x) = w(j·e^{jπ/4}·x).

use num_complex::Complex64;
use std::f64::consts::{FRAC_1_SQRT_2, PI};
use std::sync::OnceLock;

/// Phasor of an eighth of a turn, e^{jπ/4}.
pub(crate) const EIGHTH_TURN: Complex64 = Complex64::new(FRAC_1_SQRT_2, FRAC_1_SQRT_2);

/// Edge wave W(x) = e^{jx²} erfc(e^{jπ/4} x) for x ≥ 0: 1 at 0, e^{−jπ/4}/(√π x) in the limit, without
/// oscillation between.
///
/// Relative error below 1e-14 against [`edge_wave_by_series`]. W/u is smooth in u = 1/(1 + x) up to u = 0
/// (its series there is that of 1/x), and is represented by polynomials on 64 pieces of 0 ≤ u ≤ 1: 20 ns
/// where series and fractions take a microsecond.
pub(crate) fn edge_wave(x: f64) -> Complex64 {
    static PIECES: OnceLock<Vec<Coefficients>> = OnceLock::new();
    let pieces = PIECES.get_or_init(|| (0..PIECES_OF_UNIT).map(coefficients).collect());
    let u = 1.0 / (1.0 + x);
    let place = u * PIECES_OF_UNIT as f64;
    let piece = (place as usize).min(PIECES_OF_UNIT - 1);
    clenshaw(&pieces[piece], 2.0 * (place - piece as f64) - 1.0) * u
}

const PIECES_OF_UNIT: usize = 64;
/// Number of Chebyshev coefficients: ten on a 64th leave an error of 1e-18.
const TERMS: usize = 10;
type Coefficients = [Complex64; TERMS];

/// Chebyshev coefficients of W/u on a piece, from its Chebyshev points of the first kind.
fn coefficients(piece: usize) -> Coefficients {
    let angles: [f64; TERMS] = std::array::from_fn(|i| PI * (i as f64 + 0.5) / TERMS as f64);
    let values = angles.map(|angle| {
        let u = (piece as f64 + 0.5 * (1.0 + angle.cos())) / PIECES_OF_UNIT as f64;
        edge_wave_by_series(1.0 / u - 1.0) / u
    });
    std::array::from_fn(|m| {
        let sum: Complex64 = values.iter().zip(angles).map(|(v, angle)| v * (m as f64 * angle).cos()).sum();
        sum * if m == 0 { 1.0 } else { 2.0 } / TERMS as f64
    })
}

/// Sum Σ cₘ Tₘ(t) (Clenshaw 1955).
fn clenshaw(c: &Coefficients, t: f64) -> Complex64 {
    let [mut next, mut after] = [Complex64::ZERO; 2];
    for m in (1..TERMS).rev() {
        (next, after) = (c[m] + next * (2.0 * t) - after, next);
    }
    c[0] + next * t - after
}

/// W(x) by its definition: the source and the reference of the polynomials.
///
/// Error below 1e-13 (tested against quadrature): the power series of erf loses e^{x²} = 500 ε at the switch
/// to Laplace's continued fraction for erfc (Abramowitz and Stegun 7.1.14).
fn edge_wave_by_series(x: f64) -> Complex64 {
    let z = EIGHTH_TURN * x;
    if x < SERIES_END { (-erf_series(z) + 1.0) * Complex64::cis(x * x) } else { continued_fraction(z) }
}

const SERIES_END: f64 = 2.5;

/// Error function by its series, erf z = 2z/√π Σ (−z²)ⁿ/(n!(2n + 1)).
fn erf_series(z: Complex64) -> Complex64 {
    let square = -z * z;
    let (mut power, mut sum) = (Complex64::ONE, Complex64::ONE);
    for n in 1..48 {
        power *= square / f64::from(n);
        sum += power / f64::from(2 * n + 1);
    }
    z * sum * 2.0 / PI.sqrt()
}

/// Laplace's continued fraction, e^{z²} erfc z = 1/(√π(z + ½/(z + 1/(z + 3⁄2/(z + …))))), evaluated
/// backwards; it converges as e^{−c|z|√n}.
fn continued_fraction(z: Complex64) -> Complex64 {
    let terms = 16 + (360.0 / z.norm_sqr()) as u32;
    let tail = (1..=terms).rev().fold(z, |tail, n| z + 0.5 * f64::from(n) / tail);
    (PI.sqrt() * tail).inv()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::test_quadrature::gauss_legendre;

    /// W(x) by quadrature, e^{jx²}erfc(e^{jπ/4}x) = (2/√π)∫₀^∞ e^{−t² − 2e^{jπ/4}xt} dt.
    fn by_quadrature(x: f64, (nodes, weights): &(Vec<f64>, Vec<f64>)) -> Complex64 {
        let end = 6.5;
        let at = |node: f64| {
            let t = 0.5 * end * (node + 1.0);
            (-t * t - 2.0 * EIGHTH_TURN * (x * t)).exp()
        };
        nodes.iter().zip(weights).map(|(n, w)| at(*n) * w).sum::<Complex64>() * end / PI.sqrt()
    }

    #[test]
    fn both_branches_agree_with_quadrature_and_at_their_switch() {
        let rule = gauss_legendre(200);
        for step in 0..=300 {
            let x = f64::from(step) * 0.05;
            let error = (edge_wave_by_series(x) - by_quadrature(x, &rule)).norm();
            assert!(error < 1e-12, "{x}: {error:e}");
        }
        let jump = (edge_wave_by_series(SERIES_END) - edge_wave_by_series(SERIES_END.next_down())).norm();
        println!("jump at the switch: {jump:.1e}");
        assert!(jump < 1e-12);
    }

    #[test]
    fn the_polynomials_are_the_series_and_the_fraction_from_zero_to_far_off() {
        let mut worst = 0.0_f64;
        for step in 0..=20_000 {
            // 0, then 1e-8 to 1e12 in geometric steps.
            let x = if step == 0 { 0.0 } else { 10_f64.powf(f64::from(step) * 1e-3 - 8.0) };
            let known = edge_wave_by_series(x);
            worst = worst.max((edge_wave(x) - known).norm() / known.norm());
        }
        println!("relative difference of the polynomials: asked 1e-13, got {worst:.1e}");
        assert!(worst < 1e-13);
    }

    #[test]
    fn far_off_it_is_its_leading_term() {
        let x = 1e4;
        assert!((edge_wave(x) * EIGHTH_TURN * (PI.sqrt() * x) - 1.0).norm() < 1e-8);
    }
}
