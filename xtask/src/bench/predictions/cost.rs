//! Predicted and actual cost of a run, and the spread of their ratios over many runs.

use serde::{Deserialize, Serialize};

/// Processor seconds and memory of a run, predicted and actual.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct PredictedCost {
    pub(crate) said_s: f64,
    pub(crate) taken_s: f64,
    /// Expected memory.
    pub(crate) said_mib: f64,
    /// Memory that is not exceeded.
    pub(crate) most_mib: f64,
    pub(crate) held_mib: f64,
}

/// Ratio of a predicted figure to the actual one.
pub(crate) type Ratio = fn(&PredictedCost) -> f64;

/// Ratios that are told of, by their names.
pub(crate) const RATIOS: [(&str, Ratio); 3] = [
    ("seconds", |cost| cost.said_s / cost.taken_s),
    ("memory", |cost| cost.said_mib / cost.held_mib),
    ("memory at most", |cost| cost.most_mib / cost.held_mib),
];

/// Shares of the runs below each quantile of a [`Spread`].
const SHARES: [f64; 7] = [0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0];

/// Spread of a ratio over many runs.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Spread {
    pub(crate) runs: usize,
    /// Least ratio, those that 5, 25, 50, 75 and 95 % of the runs do not exceed, and the largest.
    pub(crate) quantiles: [f64; 7],
    /// Number of ratios from a half to 2.
    pub(crate) within: usize,
    /// Number of ratios below 1.
    pub(crate) below: usize,
}

impl Spread {
    pub(crate) fn of(costs: &[PredictedCost], ratio: Ratio) -> Self {
        let mut ratios: Vec<f64> = costs.iter().map(ratio).collect();
        ratios.sort_by(f64::total_cmp);
        let at =
            |share: f64| ratios.get((share * (ratios.len().max(1) - 1) as f64).round() as usize).copied();
        Self {
            runs: ratios.len(),
            quantiles: SHARES.map(|share| at(share).unwrap_or(f64::NAN)),
            within: ratios.iter().filter(|ratio| (0.5..=2.0).contains(*ratio)).count(),
            below: ratios.iter().filter(|ratio| **ratio < 1.0).count(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_has_the_ends_the_middle_and_what_is_within_a_factor_of_two() {
        let cost =
            |said_s: f64| PredictedCost { said_s, taken_s: 2.0, said_mib: 1.0, most_mib: 1.0, held_mib: 1.0 };
        let spread = Spread::of(&[4.0, 0.5, 2.0, 10.0, 1.0].map(cost), RATIOS[0].1);
        assert_eq!((spread.runs, spread.within, spread.below), (5, 3, 2));
        assert_eq!(spread.quantiles, [0.25, 0.25, 0.5, 1.0, 2.0, 5.0, 5.0]);
    }
}
