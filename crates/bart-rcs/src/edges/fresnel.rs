//! The Fresnel integral in the form that edge waves take.

use num_complex::Complex64;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// e^{jπ/4}.
pub(crate) const EIGHTH_TURN: Complex64 = Complex64::new(FRAC_1_SQRT_2, FRAC_1_SQRT_2);

/// W(x) = e^{jx²} erfc(e^{jπ/4} x) for x ≥ 0: 1 at 0, e^{−jπ/4}/(√π x) far off, without oscillation between.
///
/// Error below 1e-13 (tested against quadrature): the power series of erf loses e^{x²} = 500 ε at the switch; Laplace's
/// continued fraction for erfc (Abramowitz and Stegun 7.1.14) takes over.
pub(crate) fn edge_wave(x: f64) -> Complex64 {
    let z = EIGHTH_TURN * x;
    if x < SERIES_END { (-erf_series(z) + 1.0) * Complex64::cis(x * x) } else { continued_fraction(z) }
}

const SERIES_END: f64 = 2.5;

/// erf z = 2z/√π Σ (−z²)ⁿ/(n!(2n + 1)).
fn erf_series(z: Complex64) -> Complex64 {
    let square = -z * z;
    let (mut power, mut sum) = (Complex64::ONE, Complex64::ONE);
    for n in 1..48 {
        power *= square / f64::from(n);
        sum += power / f64::from(2 * n + 1);
    }
    z * sum * 2.0 / PI.sqrt()
}

/// e^{z²} erfc z = 1/(√π(z + ½/(z + 1/(z + 3⁄2/(z + …))))), from the far end on; it converges as e^{−c|z|√n}.
fn continued_fraction(z: Complex64) -> Complex64 {
    let terms = 3 + (360.0 / z.norm_sqr()) as u32;
    let tail = (1..=terms).rev().fold(z, |tail, n| z + 0.5 * f64::from(n) / tail);
    (PI.sqrt() * tail).inv()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_quadrature::gauss_legendre;

    /// e^{jx²}erfc(e^{jπ/4}x) = (2/√π)∫₀^∞ e^{−t² − 2e^{jπ/4}xt} dt.
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
            let error = (edge_wave(x) - by_quadrature(x, &rule)).norm();
            assert!(error < 1e-12, "{x}: {error:e}");
        }
        let jump = (edge_wave(SERIES_END) - edge_wave(SERIES_END.next_down())).norm();
        println!("jump at the switch: {jump:.1e}");
        assert!(jump < 1e-12);
    }

    #[test]
    fn far_off_it_is_its_leading_term() {
        let x = 1e4;
        assert!((edge_wave(x) * EIGHTH_TURN * (PI.sqrt() * x) - 1.0).norm() < 1e-8);
    }
}
