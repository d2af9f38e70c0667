//! Temperature scaling: one number that the logits are divided by, so that probabilities are what they say.
//!
//! Guo, Pleiss, Sun & Weinberger, On Calibration of Modern Neural Networks (arXiv:1706.04599), section 4.2. It changes no
//! answer, only how sure it is.

use crate::metrics::log_softmax;
use crate::network::Logits;
use crate::samples::Example;

/// Temperatures that are tried: e^±3, a factor of 20 either way.
const LOG_RANGE: f64 = 3.0;
/// Golden sections: the bracket shrinks to 6 · 0.618⁴⁰ = 3e-8 in the logarithm, below what f32 weights can hold.
const SECTIONS: u32 = 40;

/// The temperature of the lowest smoothed log loss on `examples`.
///
/// A validation split without a mistake would ask for temperature zero. Platt's remedy (Probabilistic Outputs for
/// Support Vector Machines, 1999, section 2.2) is kept: of n examples each class is given one that was never seen, so
/// the true class's target is 1 − 3/(n + 4) and each other's 1/(n + 4).
pub(crate) fn fitted_temperature(examples: &[Example], logits: &[Logits]) -> f64 {
    let other = 1.0 / (examples.len() as f64 + 4.0);
    let loss = |log_temperature: f64| {
        let factor = (-log_temperature).exp();
        let one = |(e, l): (&Example, &Logits)| smoothed_loss(e.class, l.map(|v| f64::from(v) * factor), other);
        examples.iter().zip(logits).map(one).sum::<f64>()
    };
    lowest(loss, [-LOG_RANGE, LOG_RANGE]).exp()
}

fn smoothed_loss(class: usize, logits: [f64; 4], other: f64) -> f64 {
    let target = |c: usize| if c == class { 1.0 - 3.0 * other } else { other };
    -log_softmax(logits).iter().enumerate().map(|(c, log_p)| target(c) * log_p).sum::<f64>()
}

/// Golden-section search; the loss has one minimum, because it is convex in 1/temperature.
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

    fn example(class: usize) -> Example {
        Example { pooled: vec![], class, model: String::new() }
    }

    #[test]
    fn answers_that_are_too_sure_are_cooled_to_their_accuracy() {
        // 70 of 100 right, each with logit 8: e⁸/(e⁸ + 3) = 0.999. Smoothed, the class's target is
        // p = 0.7 (1 − 3/104) + 0.3/104, and the loss is lowest where e^(8/T)/(e^(8/T) + 3) = p.
        let examples: Vec<Example> = (0..100).map(|i| example(if i < 70 { 0 } else { 1 + i % 3 })).collect();
        let logits = vec![[8.0, 0.0, 0.0, 0.0]; 100];
        let p = 0.7 * (1.0 - 3.0 / 104.0) + 0.3 / 104.0;
        let expected = 8.0 / (3.0_f64 * p / (1.0 - p)).ln();
        let temperature = fitted_temperature(&examples, &logits);
        // A minimum can be seen to the square root of the rounding of the loss, 100 sums of 1e-16: 1e-7; ten times that.
        assert!((temperature / expected - 1.0).abs() < 1e-6, "{temperature} {expected}");
    }

    #[test]
    fn a_split_without_mistakes_does_not_make_the_classifier_certain() {
        let logits = vec![[3.0, 0.0, 0.0, 0.0]; 20];
        let temperature = fitted_temperature(&vec![example(0); 20], &logits);
        let p = (3.0 / temperature).exp() / ((3.0 / temperature).exp() + 3.0);
        assert!((p - 21.0 / 24.0).abs() < 1e-6, "{p}");
    }
}
