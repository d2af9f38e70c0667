//! Few points over a band for a smooth function of frequency: how many, where, and the polynomial through them.
//!
//! n points meet f(x)e^{jθx} on [−1, 1], f analytic and |f| ≤ 1 in an ellipse with half axes (ρ ± 1/ρ)/2 about it, to
//! 4e^{θ(ρ − 1/ρ)/2}ρ^{1−n}/(ρ − 1), whichever ρ is taken (Trefethen, Approximation Theory and Approximation Practice (2013),
//! theorem 8.2).

use std::f64::consts::PI;

/// Chebyshev points of the second kind over a band of wavenumbers, its ends among them.
pub(crate) struct Chebyshev {
    /// From the highest on.
    pub(crate) nodes_per_m: Vec<f64>,
    /// Barycentric weights.
    weights: Vec<f64>,
}

/// More points than any band has frequencies.
const POINTS_MAX: u32 = 1 << 16;

/// Points that meet a turn of θ over half the band to an error relative to the amplitude, by an ellipse with ρ ≤ `most`.
pub(crate) fn points(turn_rad: f64, most: f64, error: f64) -> usize {
    let bound = |count: u32| {
        // Without the limit ρ = 2n/θ is best; the logarithm does not overflow.
        let rho = most.min(2.0 * f64::from(count) / turn_rad);
        let power = 0.5 * turn_rad * (rho - 1.0 / rho) - f64::from(count - 1) * rho.ln();
        if rho > 1.0 { (power + (4.0 / (rho - 1.0)).ln()).exp() } else { f64::INFINITY }
    };
    let enough = |count: &u32| bound(*count) <= error;
    (2..POINTS_MAX).find(enough).unwrap_or(POINTS_MAX) as usize
}

/// Middle and half width of a band; `None` of fewer than two wavenumbers.
pub(crate) fn middle_and_half(wavenumbers_per_m: &[f64]) -> Option<(f64, f64)> {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let [low, high] = wavenumbers_per_m.iter().fold(start, |[low, high], &k| [low.min(k), high.max(k)]);
    (low < high).then_some((0.5 * (low + high), 0.5 * (high - low)))
}

impl Chebyshev {
    /// `count` (two or more) points over the band middle ± half.
    pub(crate) fn over(middle: f64, half: f64, count: usize) -> Self {
        let angle = |i: usize| PI * i as f64 / (count - 1) as f64;
        let mut nodes_per_m: Vec<f64> = (0..count).map(|i| middle + half * angle(i).cos()).collect();
        nodes_per_m[0] = middle + half;
        let end = |i: usize| if i == 0 || i == count - 1 { 0.5 } else { 1.0 };
        let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        Self { nodes_per_m, weights: (0..count).map(|i| sign(i) * end(i)).collect() }
    }

    /// Calls `give` with every point and its share in the value at `wavenumber_per_m` of the polynomial through all
    /// (barycentric formula; Berrut, Trefethen, SIAM Review 46 (2004) 501).
    pub(crate) fn shares(&self, wavenumber_per_m: f64, mut give: impl FnMut(usize, f64)) {
        if let Some(at) = self.nodes_per_m.iter().position(|node| *node == wavenumber_per_m) {
            return give(at, 1.0);
        }
        let share = |(node, weight): (&f64, &f64)| weight / (wavenumber_per_m - node);
        let total: f64 = self.nodes_per_m.iter().zip(&self.weights).map(share).sum();
        let all = self.nodes_per_m.iter().zip(&self.weights).map(share);
        all.enumerate().for_each(|(i, s)| give(i, s / total));
    }
}
