//! Parameters of a layer and the steps that change them: AdamW (Loshchilov & Hutter, arXiv:1711.05101) with a
//! learning rate that rises and falls once over the training (Smith & Topin, arXiv:1708.07120).

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Decay of the mean of the gradient, as published.
const FIRST_DECAY: f64 = 0.9;
/// Decay of the mean of the gradient's square, as published.
const SECOND_DECAY: f64 = 0.999;
/// Least root of the mean square, as published.
const LEAST_ROOT: f64 = 1e-8;
/// Share of the training in which the rate rises.
const RISING_SHARE: f64 = 0.3;
/// First and last rate, as shares of the largest.
const FIRST_RATE: f64 = 0.04;
const LAST_RATE: f64 = 4e-6;

/// Values with their gradient and the means of its first and second power.
#[derive(Debug, Clone)]
pub(crate) struct Parameter {
    pub(crate) values: Vec<f32>,
    pub(crate) gradient: Vec<f32>,
    first: Vec<f32>,
    second: Vec<f32>,
}

impl Parameter {
    pub(crate) fn of(values: Vec<f32>) -> Self {
        let zeros = vec![0.0; values.len()];
        Self { gradient: zeros.clone(), first: zeros.clone(), second: zeros, values }
    }

    /// Values drawn evenly from ±1/√inputs (LeCun and others, Efficient BackProp, 1998, section 4.6).
    pub(crate) fn random_init(count: usize, inputs: usize, random: &mut ChaCha8Rng) -> Self {
        let bound = 1.0 / (inputs as f32).sqrt();
        Self::of((0..count).map(|_| random.random_range(-bound..bound)).collect())
    }

    /// One step against the gradient; `number` counts from 1.
    pub(crate) fn step(&mut self, number: u32, rate: f64, weight_decay: f64) {
        let [first_bias, second_bias] =
            [FIRST_DECAY, SECOND_DECAY].map(|decay| 1.0 - decay.powi(number as i32));
        for (at, value) in self.values.iter_mut().enumerate() {
            let gradient = f64::from(self.gradient[at]);
            let first = FIRST_DECAY * f64::from(self.first[at]) + (1.0 - FIRST_DECAY) * gradient;
            let second =
                SECOND_DECAY * f64::from(self.second[at]) + (1.0 - SECOND_DECAY) * gradient * gradient;
            (self.first[at], self.second[at]) = (first as f32, second as f32);
            let change = (first / first_bias) / ((second / second_bias).sqrt() + LEAST_ROOT);
            let decayed = f64::from(*value) * (1.0 - rate * weight_decay);
            *value = (decayed - rate * change) as f32;
        }
    }
}

/// Learning rate of a step (from 0) of `steps`, by half cosines up and down.
pub(crate) fn rate(step: u32, steps: u32, largest: f64) -> f64 {
    let rising = (RISING_SHARE * f64::from(steps)).max(1.0);
    let at = f64::from(step);
    let between = |from: f64, to: f64, share: f64| {
        to + 0.5 * (from - to) * (1.0 + (std::f64::consts::PI * share.clamp(0.0, 1.0)).cos())
    };
    if at < rising {
        largest * between(FIRST_RATE, 1.0, at / rising)
    } else {
        let falling = (f64::from(steps) - rising).max(1.0);
        largest * between(1.0, LAST_RATE, (at - rising) / falling)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rate_begins_low_is_largest_after_its_rise_and_ends_near_zero() {
        let rates: Vec<f64> = (0..=100).map(|step| rate(step, 100, 2.0)).collect();
        assert!((rates[0] - 0.08).abs() < 1e-12 && (rates[30] - 2.0).abs() < 1e-12, "{rates:?}");
        assert!((rates[100] - 8e-6).abs() < 1e-9, "{}", rates[100]);
        assert!(rates[..31].is_sorted() && rates[30..].iter().rev().is_sorted());
    }

    #[test]
    fn a_parabola_is_descended_to_its_lowest_point_and_decay_pulls_to_zero() {
        for (decay, expected) in [(0.0, 3.0), (1e6, 0.0)] {
            let mut parameter = Parameter::of(vec![0.5]);
            for number in 1..=4000 {
                parameter.gradient[0] = 2.0 * (parameter.values[0] - 3.0);
                parameter.step(number, rate(number - 1, 4000, 1e-2).min(0.9 / f64::max(decay, 1.0)), decay);
            }
            let reached = parameter.values[0];
            assert!((reached - expected).abs() < 1e-2, "{reached} for {expected}");
        }
    }
}
