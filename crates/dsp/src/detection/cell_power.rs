//! Distribution of the noise power of one cell, summed over channels.

use crate::numerics::incomplete_gamma::{gamma_below, gamma_tail};
use crate::numerics::saddle_point_inversion::{WeightedGamma, probability_below, weighted_by};

/// Power of a cell in units of one channel's mean: a sum of M unit exponentials (square law), weighted where
/// channels correlate.
pub(crate) struct CellPower {
    channels: usize,
    /// Groups of equal weights.
    groups: Vec<WeightedGamma>,
}

impl CellPower {
    /// Power of M independent channels.
    pub(crate) fn of_channels(channels: usize) -> Self {
        Self { channels, groups: vec![WeightedGamma { weight: 1.0, shape: channels as f64 }] }
    }

    /// Power of M channels whose correlation has these equally frequent eigenvalues of mean 1: reduced by
    /// Gauss's rule of four nodes.
    pub(crate) fn of(eigenvalues: &[f64], channels: usize) -> Self {
        const NODES: usize = 4;
        if eigenvalues.iter().all(|value| (value - 1.0).abs() < NEARLY_ONE) {
            return Self::of_channels(channels);
        }
        Self { channels, groups: weighted_by(eigenvalues, NODES, channels as f64, 1.0) }
    }

    /// Number of channels.
    pub(crate) fn channels(&self) -> usize {
        self.channels
    }

    /// Mean power, equal to the number of channels.
    pub(crate) fn mean(&self) -> f64 {
        self.channels as f64
    }

    /// Equivalent number of independent channels with the same scatter: M if all are independent.
    pub(crate) fn independent_channels(&self) -> usize {
        let variance: f64 = self.groups.iter().map(|group| group.weight.powi(2) * group.shape).sum();
        ((self.mean().powi(2) / variance).round() as usize).max(1)
    }

    /// Groups of the negated variable, as likely below 0 as the cell's power is above it.
    pub(crate) fn negated(&self) -> impl Iterator<Item = WeightedGamma> {
        self.groups.iter().map(|group| WeightedGamma { weight: -group.weight, ..*group })
    }

    /// Probability that the power exceeds a positive level.
    pub(crate) fn above(&self, level: f64) -> f64 {
        if self.are_independent() {
            return gamma_tail(self.channels, level);
        }
        probability_below(&self.negated().collect::<Vec<_>>(), -level)
    }

    /// Probability that the power is below a level.
    pub(crate) fn below(&self, level: f64) -> f64 {
        if self.are_independent() {
            return gamma_below(self.channels, level);
        }
        probability_below(&self.groups, level)
    }

    fn are_independent(&self) -> bool {
        self.groups.iter().all(|group| group.weight == 1.0)
    }
}

/// Distance from 1 below which eigenvalues count as 1: they change a tail of 1e-30 by less than a thousandth.
const NEARLY_ONE: f64 = 1e-5;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_in_pairs_of_one_value_are_half_as_many_of_twice_the_weight() {
        let (pairs, half) = (CellPower::of(&[2.0, 0.0], 12), CellPower::of_channels(6));
        for level in [1.0, 8.0, 12.0, 20.0, 60.0] {
            let (above, below) = (half.above(0.5 * level), half.below(0.5 * level));
            assert!((pairs.above(level) / above - 1.0).abs() < 1e-8, "{level}: {above}");
            assert!((pairs.below(level) / below - 1.0).abs() < 1e-8, "{level}: {below}");
        }
    }

    #[test]
    fn eigenvalues_of_independent_channels_are_the_closed_form() {
        let (asked, got) = (CellPower::of_channels(12), CellPower::of(&[1.0 + 1e-4, 1.0 - 1e-4], 12));
        for level in [3.0, 12.0, 40.0] {
            assert!((got.above(level) / asked.above(level) - 1.0).abs() < 1e-5);
            assert!((got.below(level) / asked.below(level) - 1.0).abs() < 1e-5);
        }
    }
}
