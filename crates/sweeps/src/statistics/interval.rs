//! Mean of values with the confidence interval of their expectation.

use crate::statistics::student::two_sided;

/// Possible values of a measured quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ValueRange {
    /// Values from the first to the second.
    Within([f64; 2]),
    /// Any number.
    Any,
    /// The same number in every situation, without variation.
    Fixed,
}

impl ValueRange {
    pub(crate) const SHARE: Self = Self::Within([0.0, 1.0]);

    /// Possible values of the difference of two such quantities.
    fn of_differences(self) -> Self {
        match self {
            Self::Within([least, greatest]) => Self::Within([least - greatest, greatest - least]),
            Self::Any | Self::Fixed => self,
        }
    }
}

/// Relative difference below which values are equal: rounding.
const ROUNDING: f64 = 1e-12;

/// Mean of values with its interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Mean {
    pub(crate) value: f64,
    /// Standard error of the mean; `None` for a single value, which has no spread.
    pub(crate) standard_error: Option<f64>,
    /// Half the width of the interval, the greater half if they differ; `None` for a single value, and for
    /// unbounded values that are all equal.
    pub(crate) half_width: Option<f64>,
    /// Both ends of the interval, within the bounds of the values; `None` in the same cases.
    pub(crate) ends: Option<[f64; 2]>,
    /// Number of values.
    pub(crate) count: usize,
}

impl Mean {
    /// Mean of normal values and Student's interval at a confidence; `None` without values.
    pub(crate) fn of(values: &[f64], confidence: f64) -> Option<Self> {
        let count = values.len();
        let first = *values.first()?;
        // The mean of equal values is that value for any number of them: rounding would depend on it.
        let are_equal = values.iter().all(|value| *value == first);
        let value = if are_equal { first } else { values.iter().sum::<f64>() / count as f64 };
        let squares: f64 = values.iter().map(|v| (v - value).powi(2)).sum();
        let standard_error = (count > 1).then(|| (squares / (count - 1) as f64 / count as f64).sqrt());
        let half_width = standard_error.map(|error| two_sided(confidence, count - 1) * error);
        let ends = half_width.map(|half| [value - half, value + half]);
        Some(Self { value, standard_error, half_width, ends, count })
    }

    /// Mean of values on a scale. If all values are equal, their spread is uninformative: that many equal
    /// trials are consistent with a probability of ((1 − confidence)/2)^(1/count) and more (Clopper and
    /// Pearson, Biometrika 26 (1934) 404), and the other outcomes are at worst at either bound. For unbounded
    /// values the interval is then unknown.
    pub(crate) fn on_scale(values: &[f64], scale: ValueRange, confidence: f64) -> Option<Self> {
        let mean = Self::of(values, confidence)?;
        let alike = (0.5 * (1.0 - confidence)).powf(1.0 / mean.count as f64);
        let of_alike = |bounds: [f64; 2]| bounds.map(|end| alike * mean.value + (1.0 - alike) * end);
        Some(match (scale, mean.ends) {
            (ValueRange::Within(bounds), Some(_)) if are_alike(values) => {
                let [low, high] = of_alike(bounds);
                let half_width = Some((mean.value - low).max(high - mean.value));
                Self { half_width, ends: Some([low, high]), ..mean }
            }
            (ValueRange::Within([least, greatest]), Some(ends)) => {
                Self { ends: Some(ends.map(|end| end.clamp(least, greatest))), ..mean }
            }
            (ValueRange::Any, _) if are_alike(values) => Self { half_width: None, ends: None, ..mean },
            (ValueRange::Within(_), None) | (ValueRange::Any | ValueRange::Fixed, _) => mean,
        })
    }

    /// Mean of the known values.
    pub(crate) fn of_known(values: &[Option<f64>], confidence: f64) -> Option<Self> {
        Self::of(&known(values), confidence)
    }

    /// Mean of the differences `a` − `b` of values on a scale, in situations in which both are known.
    pub(crate) fn of_pairs([a, b]: [&[Option<f64>]; 2], scale: ValueRange, confidence: f64) -> Option<Self> {
        let differences: Vec<f64> = a.iter().zip(b).filter_map(|(a, b)| Some((*a)? - (*b)?)).collect();
        Self::on_scale(&differences, scale.of_differences(), confidence)
    }

    /// Lower end; −∞ if the spread is unknown.
    pub(crate) fn low(&self) -> f64 {
        self.ends.map_or(f64::NEG_INFINITY, |[low, _]| low)
    }
}

fn are_alike(values: &[f64]) -> bool {
    let largest = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    values.iter().all(|value| (value - values[0]).abs() <= ROUNDING * largest)
}

/// The known values.
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
        let shares = |shares: &[f64]| Mean::on_scale(shares, ValueRange::SHARE, 0.95).unwrap();
        let all = shares(&[1.0; 6]);
        let low = 0.025_f64.powf(1.0 / 6.0);
        let is = |ends: Option<[f64; 2]>, [from, to]: [f64; 2]| {
            ends.is_some_and(|ends| (ends[0] - from).abs() < 1e-12 && (ends[1] - to).abs() < 1e-12)
        };
        assert_eq!((all.value, all.standard_error), (1.0, Some(0.0)));
        assert!(is(all.ends, [low, 1.0]), "{all:?}");
        let none = shares(&[0.0; 6]);
        assert!(none.value == 0.0 && is(none.ends, [0.0, 1.0 - low]), "{none:?}");
        let halves = shares(&[0.5; 6]);
        assert!(is(halves.ends, [0.5 * low, 1.0 - 0.5 * low]), "{halves:?}");
        let some = shares(&[1.0, 0.5, 1.0]);
        let ends = some.ends.unwrap();
        assert!(some.value + some.half_width.unwrap() > 1.0 && ends[1] == 1.0 && ends[0] > 0.0, "{some:?}");
        assert_eq!(shares(&[1.0]).ends, None);
    }

    /// Shares of a coin that falls right in nineteen of twenty: six of them are all right three times of
    /// four, and an interval without width would hold the truth in none of these.
    #[test]
    fn intervals_of_shares_hold_the_truth_as_often_as_they_say() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let mut holds = || {
            let shares = [(); 6].map(|()| f64::from(u8::from(random.random::<f64>() < 0.95)));
            let [low, high] = Mean::on_scale(&shares, ValueRange::SHARE, 0.95).unwrap().ends.unwrap();
            (low..=high).contains(&0.95)
        };
        let held = (0..1000).filter(|_| holds()).count();
        assert!(held >= 950, "{held} of 1000");
    }

    #[test]
    fn what_two_designs_share_falls_out_of_their_difference() {
        let a = [Some(10.0), Some(21.0), None, Some(32.0)];
        let b = [Some(9.0), Some(20.0), Some(5.0), None];
        let pairs = Mean::of_pairs([&a, &b], ValueRange::Fixed, 0.95).unwrap();
        assert_eq!((pairs.value, pairs.half_width, pairs.count), (1.0, Some(0.0), 2));
    }

    #[test]
    fn differences_that_agree_in_few_situations_may_be_others_in_the_next() {
        let of = |a: f64, b: f64, scale| Mean::of_pairs([&[Some(a); 6], &[Some(b); 6]], scale, 0.95).unwrap();
        let alike = 0.025_f64.powf(1.0 / 6.0);
        let equal = of(0.7, 0.7, ValueRange::SHARE);
        assert!((equal.half_width.unwrap() - (1.0 - alike)).abs() < 1e-12, "{equal:?}");
        assert!((equal.low() + 1.0 - alike).abs() < 1e-12, "{equal:?}");
        let [whole, half] = [0.0, 0.5].map(|share| of(1.0, share, ValueRange::SHARE));
        assert!(
            whole.low() > 0.05 && whole.ends.unwrap()[1] == 1.0 && half.low() < 0.0,
            "{whole:?} {half:?}"
        );
        let [any, fixed] = [ValueRange::Any, ValueRange::Fixed].map(|scale| of(3.0, 2.0, scale));
        assert_eq!((any.value, any.half_width, any.low()), (1.0, None, f64::NEG_INFINITY));
        assert_eq!((fixed.half_width, fixed.low()), (Some(0.0), 1.0));
    }

    /// Two designs that differ in one situation of twenty, there by the whole share: six situations agree
    /// three times of four.
    #[test]
    fn intervals_of_differences_hold_the_truth_as_often_as_they_say() {
        let mut random = ChaCha8Rng::seed_from_u64(8);
        let mut holds = || {
            let other = [(); 6].map(|()| Some(f64::from(u8::from(random.random::<f64>() < 0.05))));
            let [low, high] =
                Mean::of_pairs([&other, &[Some(0.0); 6]], ValueRange::SHARE, 0.95).unwrap().ends.unwrap();
            (low..=high).contains(&0.05)
        };
        let held = (0..1000).filter(|_| holds()).count();
        assert!(held >= 950, "{held} of 1000");
    }
}
