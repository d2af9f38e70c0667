//! Mean of some values with the interval in which their expectation lies.

use crate::statistics::student::two_sided;

/// Mean of values and its interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Mean {
    pub(crate) value: f64,
    /// Standard error of the mean; `None` of a single value, which tells of no spread.
    pub(crate) standard_error: Option<f64>,
    /// Half the width of the interval; `None` likewise.
    pub(crate) half_width: Option<f64>,
    /// Both ends of the interval, those of a share within 0 and 1; `None` likewise.
    pub(crate) ends: Option<[f64; 2]>,
    /// Number of values.
    pub(crate) count: usize,
}

impl Mean {
    /// Mean of normal values and Student's interval at a confidence; `None` of no value.
    pub(crate) fn of(values: &[f64], confidence: f64) -> Option<Self> {
        let count = values.len();
        let value = (count > 0).then(|| values.iter().sum::<f64>() / count as f64)?;
        let squares: f64 = values.iter().map(|v| (v - value).powi(2)).sum();
        let standard_error = (count > 1).then(|| (squares / (count - 1) as f64 / count as f64).sqrt());
        let half_width = standard_error.map(|error| two_sided(confidence, count - 1) * error);
        let ends = half_width.map(|half| [value - half, value + half]);
        Some(Self { value, standard_error, half_width, ends, count })
    }

    /// Mean of shares. Where all are 1, or all 0, their spread says nothing: as many trials that all came out
    /// alike may be of a chance that is ((1 − confidence)/2)^(1/count) away from none (Clopper and Pearson,
    /// Biometrika 26 (1934) 404), and the mean of shares is no nearer to the middle than that.
    pub(crate) fn of_shares(shares: &[f64], confidence: f64) -> Option<Self> {
        let mean = Self::of(shares, confidence)?;
        let are_alike = [0.0, 1.0].iter().any(|end| shares.iter().all(|share| share == end));
        let chance = || (0.5 * (1.0 - confidence)).powf(1.0 / mean.count as f64);
        let half_width = mean.half_width.map(|half| if are_alike { 1.0 - chance() } else { half });
        let ends =
            half_width.map(|half| [mean.value - half, mean.value + half].map(|end| end.clamp(0.0, 1.0)));
        Some(Self { half_width, ends, ..mean })
    }

    /// Mean of what is known.
    pub(crate) fn of_known(values: &[Option<f64>], confidence: f64) -> Option<Self> {
        Self::of(&known(values), confidence)
    }

    /// Mean of the differences `a` − `b` in situations in which both are known.
    pub(crate) fn of_pairs(a: &[Option<f64>], b: &[Option<f64>], confidence: f64) -> Option<Self> {
        let differences: Vec<f64> = a.iter().zip(b).filter_map(|(a, b)| Some((*a)? - (*b)?)).collect();
        Self::of(&differences, confidence)
    }

    /// Lower end; −∞ where no spread is known.
    pub(crate) fn low(&self) -> f64 {
        self.half_width.map_or(f64::NEG_INFINITY, |half| self.value - half)
    }
}

/// Values that are known.
pub(crate) fn known(values: &[Option<f64>]) -> Vec<f64> {
    values.iter().copied().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn the_interval_of_three_values_is_that_of_the_closed_form() {
        // Mean 2, standard deviation 1; t at 95 % with two degrees of freedom is 0.95/√(2·0.975·0.025).
        let mean = Mean::of(&[1.0, 2.0, 3.0], 0.95).unwrap();
        let half = 0.95 / (2.0_f64 * 0.975 * 0.025).sqrt() / 3.0_f64.sqrt();
        assert_eq!((mean.value, mean.count), (2.0, 3));
        assert!((mean.half_width.unwrap() - half).abs() < 1e-9);
    }

    #[test]
    fn one_value_tells_of_no_spread_and_none_of_no_mean() {
        let lone = Mean::of(&[4.0], 0.9).unwrap();
        assert_eq!((lone.value, lone.standard_error, lone.half_width, lone.count), (4.0, None, None, 1));
        assert_eq!(lone.low(), f64::NEG_INFINITY);
        assert_eq!(Mean::of(&[], 0.9), None);
    }

    #[test]
    fn shares_that_are_all_alike_still_have_an_interval_and_none_leaves_0_to_1() {
        let all = Mean::of_shares(&[1.0; 6], 0.95).unwrap();
        let low = 0.025_f64.powf(1.0 / 6.0);
        let is = |ends: Option<[f64; 2]>, [from, to]: [f64; 2]| {
            ends.is_some_and(|ends| (ends[0] - from).abs() < 1e-12 && (ends[1] - to).abs() < 1e-12)
        };
        assert_eq!((all.value, all.standard_error), (1.0, Some(0.0)));
        assert!(is(all.ends, [low, 1.0]), "{all:?}");
        let none = Mean::of_shares(&[0.0; 6], 0.95).unwrap();
        assert!(none.value == 0.0 && is(none.ends, [0.0, 1.0 - low]), "{none:?}");
        let some = Mean::of_shares(&[1.0, 0.5, 1.0], 0.95).unwrap();
        let ends = some.ends.unwrap();
        assert!(some.value + some.half_width.unwrap() > 1.0 && ends[1] == 1.0 && ends[0] > 0.0, "{some:?}");
        assert_eq!(Mean::of_shares(&[1.0], 0.95).unwrap().ends, None);
    }

    /// Shares of a coin that falls right in nineteen of twenty: six of them are all right three times of
    /// four, and an interval without width would hold the truth in none of these.
    #[test]
    fn intervals_of_shares_hold_the_truth_as_often_as_they_say() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let mut holds = || {
            let shares = [(); 6].map(|()| f64::from(u8::from(random.random::<f64>() < 0.95)));
            let [low, high] = Mean::of_shares(&shares, 0.95).unwrap().ends.unwrap();
            (low..=high).contains(&0.95)
        };
        let held = (0..1000).filter(|_| holds()).count();
        assert!(held >= 950, "{held} of 1000");
    }

    #[test]
    fn what_two_designs_share_falls_out_of_their_difference() {
        let a = [Some(10.0), Some(21.0), None, Some(32.0)];
        let b = [Some(9.0), Some(20.0), Some(5.0), None];
        let pairs = Mean::of_pairs(&a, &b, 0.95).unwrap();
        assert_eq!((pairs.value, pairs.half_width, pairs.count), (1.0, Some(0.0), 2));
    }
}
