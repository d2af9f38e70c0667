//! Dimensions: nominal for seed 0, spread over real ranges for every other seed.

use std::ops::RangeInclusive;

/// Draws the dimensions of one vehicle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ParameterSampler<'a> {
    pub(crate) model: &'a str,
    pub(crate) seed: u64,
}

impl ParameterSampler<'_> {
    /// Draws a dimension: `nominal` for seed 0, else uniform over `range`; `what` names it, so that
    /// additional dimensions do not change others.
    pub(crate) fn value(&self, what: &str, nominal: f64, range: RangeInclusive<f64>) -> f64 {
        if self.seed == 0 {
            return nominal;
        }
        let drawn = artifact::seed::derived(self.seed, &format!("vehicles/{}/{what}", self.model), &[]);
        // 53 bits, so that the fraction is exact and below 1.
        let fraction = drawn as f64 / (1_u64 << 53) as f64;
        range.start() + (range.end() - range.start()) * fraction
    }

    /// Overall length, width over mirrors (handlebar) and height.
    pub(crate) fn size_m(&self, size: &SizeRange) -> [f64; 3] {
        [(0, "length"), (1, "width"), (2, "height")].map(|(k, what)| {
            let [low, high] = size.range_m[k];
            self.value(what, size.nominal_m[k], low..=high)
        })
    }
}

/// Nominal length, width, height and their ranges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SizeRange {
    pub(crate) nominal_m: [f64; 3],
    pub(crate) range_m: [[f64; 2]; 3],
}
