//! Distribution of weighted sums of Gamma variables, the form of every noise estimate and of every comparison
//! with it: Bromwich inversion of the Laplace transform along a saddle-point contour.
//!
//! Q = Σ_q w_q·G(n_q), G of unit scale and shape n_q, has E e^{−sQ} = Π(1 + s·w_q)^{−n_q}, so that P(Q < t) =
//! 1/(2πj) ∫ e^{st} Π(1 + s·w_q)^{−n_q} ds/s on any line right of 0 and left of the first −1/w_q > 0
//! (Bromwich's inversion). The line passes through the integrand's saddle point, where nothing cancels
//! (Helstrom, IEEE T-AES 19 (1983) 428), and bends along the path of steepest descent; the trapezoidal rule
//! then converges geometrically.

use crate::numerics::gauss_quadrature::gauss_nodes;
use num_complex::Complex64;
use std::f64::consts::PI;

/// Weight w_q and shape n_q of one Gamma variable of a sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WeightedGamma {
    /// Weight w_q, not zero; may be negative.
    pub(crate) weight: f64,
    /// Shape n_q, positive and not necessarily an integer.
    pub(crate) shape: f64,
}

/// Variables of a sum of `count` unit exponentials whose weights are `scale` times these equally frequent
/// eigenvalues, reduced by Gauss's rule of `nodes` nodes.
pub(crate) fn weighted_by(eigenvalues: &[f64], nodes: usize, count: f64, scale: f64) -> Vec<WeightedGamma> {
    let group = |(value, share): (f64, f64)| WeightedGamma { weight: value / scale, shape: share * count };
    let groups = gauss_nodes(eigenvalues, nodes).into_iter().map(group);
    groups.filter(|g| g.shape > 1e-9 && g.weight > 0.0).collect()
}

/// Probability P(Σ w_q·G(n_q) < t), with a relative error of about 1e-11, also far out in the lower tail.
///
/// The upper tail is the complement of P(Σ −w_q·G(n_q) < −t). Near the mean both forms hold on the side of
/// the longer tail; on the other side the bent path approaches the far pole (5e-10 at the mean of shapes 70
/// times apart), and farther out crosses it.
///
/// At least one weight is positive, and `t` is positive or some weight is negative.
pub(crate) fn probability_below(form: &[WeightedGamma], t: f64) -> f64 {
    let cumulant = |n: i32| form.iter().map(|g| g.weight.powi(n) * g.shape).sum::<f64>();
    if t <= cumulant(1) + FROM_MEAN * cumulant(2).sqrt().copysign(cumulant(3)) {
        return lower_tail(form, t);
    }
    let opposite: Vec<_> = form.iter().map(|g| WeightedGamma { weight: -g.weight, ..*g }).collect();
    1.0 - lower_tail(&opposite, -t)
}

/// Standard deviations from the mean, on the side of the longer tail, up to which the lower tail is summed.
const FROM_MEAN: f64 = 0.75;

/// Probability of [`probability_below`] by a single contour.
fn lower_tail(form: &[WeightedGamma], t: f64) -> f64 {
    let saddle = saddle_point(form, t);
    let [_, second, third] = slopes(form, t, saddle);
    let width = 1.0 / second.sqrt();
    // Re s falls by φ‴/6φ″ of the square of Im s where the exponent φ stays real to third order.
    let bend = -third * width / (3.0 * second);
    let peak = exponent(form, t, Complex64::from(saddle)).re;
    let term = |x: f64| {
        let s = saddle + width * Complex64::new(-bend * (x.cosh() - 1.0), x.sinh());
        let step = width * Complex64::new(-bend * x.sinh(), x.cosh());
        ((exponent(form, t, s) - peak).exp() * step).im
    };
    let mut sum = 0.5 * term(0.0);
    for i in 1..TRAPEZOIDS {
        let value = term(f64::from(i) * STEP);
        sum += value;
        // The slowest forms (Σn = 1) decay like e^{−x}: the remainder is about the last term over STEP.
        if value.abs() < 1e-16 * sum.abs() && f64::from(i) * STEP > 6.0 {
            break;
        }
    }
    (sum * STEP / PI * peak.exp()).clamp(0.0, 1.0)
}

/// Step of the trapezoidal rule: the integrand has no pole within 0.4 of the real axis of x, so the error is
/// below e^{−2π·0.4/STEP} = 1e-11.
const STEP: f64 = 0.1;
const TRAPEZOIDS: i32 = 400;

/// Exponent of the integrand, st − Σ n ln(1 + s·w) − ln s.
fn exponent(form: &[WeightedGamma], t: f64, s: Complex64) -> Complex64 {
    form.iter().fold(s * t - s.ln(), |sum, g| sum - g.shape * (1.0 + s * g.weight).ln())
}

/// First three derivatives of the exponent on the real axis.
fn slopes(form: &[WeightedGamma], t: f64, s: f64) -> [f64; 3] {
    let pole = [t - 1.0 / s, 1.0 / (s * s), -2.0 / (s * s * s)];
    form.iter().fold(pole, |[first, second, third], g| {
        let ratio = g.weight / (1.0 + s * g.weight);
        [first - g.shape * ratio, second + g.shape * ratio.powi(2), third - 2.0 * g.shape * ratio.powi(3)]
    })
}

/// Finds the minimum of the exponent, which is convex between its poles, by Newton's method, with bisection
/// when a step leaves the bracket.
fn saddle_point(form: &[WeightedGamma], t: f64) -> f64 {
    let pole = form.iter().filter(|g| g.weight < 0.0).map(|g| -1.0 / g.weight).fold(f64::INFINITY, f64::min);
    let (mut low, mut high) = (0.0, pole);
    if !high.is_finite() {
        high = 1.0 / t;
        while slopes(form, t, high)[0] < 0.0 {
            (low, high) = (high, 2.0 * high);
        }
        // The bracket's upper end may be the point itself.
        high *= 2.0;
    }
    let mut s = 0.5 * (low + high);
    for _ in 0..200 {
        let [first, second, _] = slopes(form, t, s);
        if first > 0.0 {
            high = s
        } else {
            low = s
        }
        let newton = s - first / second;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        // Any point near the saddle works; this one is near enough that no digit is lost.
        if (next - s).abs() <= 1e-6 * s {
            return next;
        }
        s = next;
    }
    s
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::incomplete_beta::beta_below;
    use statrs::function::gamma::gamma_lr;

    #[test]
    fn one_gamma_variable_has_the_incomplete_gamma_function() {
        for shape in [1.0, 2.5, 13.0, 192.0, 3000.0] {
            for t in [0.3, 0.7, 1.0, 1.2, 2.0] {
                let asked = gamma_lr(shape, t * shape);
                let got = probability_below(&[WeightedGamma { weight: 1.0 / shape, shape }], t);
                let tolerance = 1e-9 * asked + 1e-13;
                assert!(
                    asked < 1e-250 || (got - asked).abs() < tolerance,
                    "{shape}, {t}: {got:e} against {asked:e}"
                );
            }
        }
    }

    #[test]
    fn a_difference_of_lopsided_shapes_has_both_its_tails() {
        // P((1 − u)A − uB < 0) = I_u(a, b), computed independently in its own module.
        for (a, b) in [(859.2, 12.0), (2976.0, 12.0), (12.0, 859.2), (47616.0, 192.0), (2e4, 1.0), (1.0, 2e4)]
        {
            for odds in [0.2, 0.5, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.4, 2.0, 5.0] {
                let u = odds * a / (odds * a + b);
                let form =
                    [WeightedGamma { weight: 1.0 - u, shape: a }, WeightedGamma { weight: -u, shape: b }];
                let (got, asked) = (probability_below(&form, 0.0), beta_below(a, b, u));
                assert!((got / asked - 1.0).abs() < 2e-11, "{a}, {b}, {u}: {got:e} against {asked:e}");
            }
        }
    }

    #[test]
    fn two_exponentials_of_different_weight_have_their_closed_form() {
        // P(w₁E₁ + w₂E₂ < t) = 1 − (w₁e^{−t/w₁} − w₂e^{−t/w₂})/(w₁ − w₂).
        let form = [WeightedGamma { weight: 2.0, shape: 1.0 }, WeightedGamma { weight: 0.5, shape: 1.0 }];
        for t in [0.1_f64, 1.0, 5.0] {
            let asked = 1.0 - (2.0 * (-t / 2.0).exp() - 0.5 * (-t / 0.5).exp()) / 1.5;
            let got = probability_below(&form, t);
            assert!((got / asked - 1.0).abs() < 1e-10, "{t}: {got} against {asked}");
        }
    }
}
