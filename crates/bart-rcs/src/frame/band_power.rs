//! Sums and mean powers over the band of a radar.

use crate::frame::path_plan::Plan;
use crate::frame::path_sum::element_over_band;
use artifact::paths::Path;
use num_complex::Complex64;

/// Margin of a measured error. The ratio of two mean powers of n complex Gaussian samples follows the F
/// distribution with (2n, 2n) degrees of freedom. Scatterers of one vehicle in a few range cells leave about
/// 4 of the 12 frequencies independent: 95 of 100 ratios stay below F(0.95; 8, 8) = 3.44, as an amplitude
/// 1.85.
pub(crate) const MARGIN: f64 = 1.85;

/// Centres of equal parts of the sampled sweep.
pub(crate) fn frequencies_hz(centre_hz: f64, bandwidth_hz: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| centre_hz + bandwidth_hz * ((i as f64 + 0.5) / count as f64 - 0.5)).collect()
}

/// Mean power of the sum over the band at the frame's ends and middle, between the pairs of elements that
/// represent the array.
pub(crate) fn power_over_frame(paths: &[Path], plan: &Plan<'_>) -> f64 {
    const FREQUENCIES: usize = 24;
    let frequencies = frequencies_hz(plan.band.centre_hz, plan.band.bandwidth_hz, FREQUENCIES);
    let pairs = plan.pairs_of_array_m();
    let moments = [0.0, plan.middle_s, 2.0 * plan.middle_s];
    let views = pairs.iter().flat_map(|ends_m| moments.map(|seconds| plan.view_from(*ends_m, seconds)));
    let powers = views.map(|view| mean(&element_over_band(paths, &view, plan.reception(), &frequencies)));
    powers.sum::<f64>() / (pairs.len() * moments.len()) as f64
}

/// Sum over orders, at each of `count` frequencies.
pub(crate) fn total(orders: impl Iterator<Item = Vec<Complex64>>, count: usize) -> Vec<Complex64> {
    orders
        .fold(vec![Complex64::ZERO; count], |all, order| all.iter().zip(&order).map(|(a, b)| a + b).collect())
}

/// Mean of |a − b|².
pub(crate) fn mean_difference(a: &[Complex64], b: &[Complex64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).norm_sqr()).sum::<f64>() / a.len().max(1) as f64
}

/// Mean of |S|².
pub(crate) fn mean(values: &[Complex64]) -> f64 {
    values.iter().map(|s| s.norm_sqr()).sum::<f64>() / values.len().max(1) as f64
}
