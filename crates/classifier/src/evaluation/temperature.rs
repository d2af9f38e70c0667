//! Temperature scaling: a single divisor of the logits that calibrates the probabilities.
//!
//! Guo, Pleiss, Sun & Weinberger, On Calibration of Modern Neural Networks (arXiv:1706.04599), section 4.2.
//! It changes the confidence of the answers, not the answers.

use crate::crops::network::Logits;
use crate::evaluation::metrics::log_softmax;

/// Range of ln T that is searched: e^±3, a factor of 20 either way.
const LOG_RANGE: f64 = 3.0;
/// Golden-section steps: the bracket shrinks to 6 · 0.618⁴⁰ = 3e-8 in the logarithm, below the precision of
/// f32 weights.
const SECTIONS: u32 = 40;

/// The maximum a posteriori temperature of answers, given as true class and logits with weights, with a prior
/// of ln T that is normal about zero with deviation ln 2.
///
/// Without the prior a validation split without errors would give temperature zero, i.e. certainty; the prior
/// has the weight of about one example.
pub fn fitted_temperature(answers: &[(usize, Logits, f64)]) -> f64 {
    let loss = |log_temperature: f64| {
        let factor = (-log_temperature).exp();
        let one = |(class, l, weight): &(usize, Logits, f64)| {
            -weight * log_softmax(l.map(|v| f64::from(v) * factor))[*class]
        };
        let prior = 0.5 * (log_temperature / std::f64::consts::LN_2).powi(2);
        answers.iter().map(one).sum::<f64>() + prior
    };
    lowest(loss, [-LOG_RANGE, LOG_RANGE]).exp()
}

/// Golden-section search; the loss has a single minimum, because it is convex in 1/temperature.
fn lowest(loss: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..SECTIONS {
        let (left, right) = (high - golden * (high - low), low + golden * (high - low));
        if loss(left) < loss(right) { high = right } else { low = left }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_that_are_too_sure_are_cooled_to_their_accuracy() {
        // 70 of 100 right, each with logit 8: e⁸/(e⁸ + 3) = 0.999. The loss is lowest where e^(8/T)/(e^(8/T)
        // + 3) = 0.7.
        let n = 100_000;
        let class = |i: usize| if i % 10 < 7 { 0 } else { 1 + i % 3 };
        let answers: Vec<_> = (0..n).map(|i| (class(i), [8.0, 0.0, 0.0, 0.0], 1.0)).collect();
        let temperature = fitted_temperature(&answers);
        let expected = 8.0 / (3.0_f64 * 0.7 / 0.3).ln();
        // The prior pulls ln T = 1.41 towards 0 by 1.41/ln²2 over the information n (8/T)² 0.7 · 0.3 = 0.8 n:
        // 3.7e-5.
        assert!((temperature / expected - 1.0).abs() < 5e-5, "{temperature} {expected}");
    }

    #[test]
    fn a_split_without_mistakes_does_not_make_the_classifier_certain() {
        let temperature = fitted_temperature(&[(0, [3.0, 0.0, 0.0, 0.0], 1.0); 20]);
        // There the pull of 20 right answers equals that of the prior: 20 (3/T)(1 − p) = −ln T / ln²2.
        let p = (3.0 / temperature).exp() / ((3.0 / temperature).exp() + 3.0);
        let pull = 20.0 * 3.0 / temperature * (1.0 - p);
        let prior = -temperature.ln() / std::f64::consts::LN_2.powi(2);
        // A minimum is seen to the square root of the rounding of the loss, 1e-8; the slopes change by about
        // 10 per unit.
        assert!((pull - prior).abs() < 1e-6 && p < 0.99, "{pull} {prior} {p}");
    }
}
