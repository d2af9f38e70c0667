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
        Some(Self { value, standard_error, half_width, count })
    }

    /// Mean of what is known.
    pub(crate) fn of_known(values: &[Option<f64>], confidence: f64) -> Option<Self> {
        Self::of(&values.iter().copied().flatten().collect::<Vec<_>>(), confidence)
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

#[cfg(test)]
mod tests {
    use super::*;

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
    fn what_two_designs_share_falls_out_of_their_difference() {
        let a = [Some(10.0), Some(21.0), None, Some(32.0)];
        let b = [Some(9.0), Some(20.0), Some(5.0), None];
        let pairs = Mean::of_pairs(&a, &b, 0.95).unwrap();
        assert_eq!((pairs.value, pairs.half_width, pairs.count), (1.0, Some(0.0), 2));
    }
}
