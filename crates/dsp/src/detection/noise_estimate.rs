//! Threshold factors for every noise estimate: P_fa = P(y > α·T), y the cell under test, T the estimate.
//!
//! y is a sum of M unit exponentials (square law, M channels; weighted where bands of Doppler division
//! overlap, `cell_power.rs`), independent of T. If T is one sum of Gamma variables (cell averaging), y > αT
//! is a statement about such a sum too. Otherwise P_fa = ∫ P(y > αt) dG(t) over the distribution G of T,
//! which is known in closed form:
//!
//! - greatest and smallest of two halves (Hansen, Sawyers, IEEE T-AES 16 (1980) 115; Trunk, T-AES 14 (1978)
//!   750): G = F_A·F_B and G = 1 − (1 − F_A)(1 − F_B), F of each half's mean;
//! - ordered statistic (Rohling, IEEE T-AES 19 (1983) 608): G(t) = I_u(k, N − k + 1), u = P(one cell < t).
//!   One channel yields Rohling's product P_fa = Π_{i<k} (N − i)/(N − i + α).

use crate::detection::cell_power::CellPower;
use crate::detection::correlated_cells::{Correlation, Region};
use crate::numerics::incomplete_beta::beta_below;
use crate::numerics::regula_falsi::falling_root;
use crate::numerics::saddle_point_inversion::{WeightedGamma, probability_below};

/// Threshold factor α for the mean of a region's cells.
pub(crate) fn ca_factor(mean: &[WeightedGamma], cell: &CellPower, rate: f64) -> f64 {
    falling_root(rate, |factor| {
        let scaled = |g: &WeightedGamma| WeightedGamma { weight: g.weight * factor * cell.mean(), ..*g };
        let form: Vec<_> = mean.iter().map(scaled).chain(cell.negated()).collect();
        probability_below(&form, 0.0)
    })
}

/// Threshold factor α for the greater mean of two regions with independent noise.
pub(crate) fn go_factor(halves: [&[WeightedGamma]; 2], cell: &CellPower, rate: f64) -> f64 {
    factor(cell, rate, |t| halves.map(|half| probability_below(half, t)).iter().product())
}

/// Threshold factor α for the smaller mean of two regions with independent noise.
pub(crate) fn so_factor(halves: [&[WeightedGamma]; 2], cell: &CellPower, rate: f64) -> f64 {
    factor(cell, rate, |t| {
        let [a, b] = halves.map(|half| probability_below(half, t));
        // 1 − (1 − a)(1 − b) without cancellation for small a and b.
        a + b - a * b
    })
}

/// Threshold factor α for the cell of this rank, counted from 1 at the weakest, of independent cells.
pub(crate) fn os_factor(cells: usize, rank: usize, cell: &CellPower, rate: f64) -> f64 {
    let (below, above) = (rank as f64, (cells - rank + 1) as f64);
    factor(cell, rate, |t| beta_below(below, above, cell.below(cell.mean() * t)))
}

/// Threshold factor α for the cell of this rank of a region with correlated cells.
///
/// T < t if at least k of the N cells lie below t. Their number has the mean N·u, and, by Kibble's expansion
/// of two correlated Gamma variables (Sankhyā 5 (1941) 137), the variance N·u(1 − u) + Σ_n c_n² Σ_{i≠j}
/// κ_ij^n, c_n the coefficients of the step at t in Laguerre polynomials. It equals that of n = N·(N u(1 −
/// u))/variance independent cells, each counted N/n times, of which k′ − ½ = (k − ½)·n/N are required (½:
/// counts are integers).
pub(crate) fn correlated_os_factor(
    correlation: &Correlation,
    region: &Region,
    rank: usize,
    cell: &CellPower,
    rate: f64,
) -> f64 {
    let (cells, asked) = (region.cells() as f64, rank as f64 - 0.5);
    let channels = cell.independent_channels();
    let among: Vec<f64> = (1..=TERMS as i32).map(|n| correlation.among(region, n)).collect();
    factor(cell, rate, |t| {
        let u = cell.below(cell.mean() * t);
        let independent = cells * u * (1.0 - u);
        let coefficients = step_coefficients(channels, channels as f64 * t);
        let shared: f64 = coefficients.zip(&among).map(|(c, sum)| c * c * sum).sum();
        let fewer = if independent > 0.0 { independent / (independent + shared) } else { 1.0 };
        let below = asked * fewer + 0.5;
        beta_below(below, cells * fewer + 1.0 - below, u)
    })
}

/// Number of terms of Kibble's expansion: κ^60 of the widest window's neighbours (0.8) is 2e-6.
const TERMS: usize = 60;

/// Coefficients c_n of the step at t, n = 1, 2, …: ∫₀^t x^{M−1}e^{−x}/Γ(M)·φ_n dx =
/// t^M e^{−t}/Γ(M)·L_{n−1}^{(M)}(t)/n·√(n!Γ(M)/Γ(n+M)).
fn step_coefficients(channels: usize, t: f64) -> impl Iterator<Item = f64> {
    let m = channels as f64;
    let ln_density = (1..=channels).map(|k| (t / k as f64).ln()).sum::<f64>() + m.ln() - t;
    let (mut before, mut polynomial, mut ln_norm) = (0.0, 1.0, 0.0);
    (1..=TERMS).map(move |n| {
        let n = n as f64;
        // n!·Γ(M)/Γ(n + M), factor by factor.
        ln_norm += (n / (n - 1.0 + m)).ln();
        let coefficient = polynomial / n * (ln_density + 0.5 * ln_norm).exp();
        // n·L_n = (2n − 1 + M − t)·L_{n−1} − (n − 1 + M)·L_{n−2}, here of upper index M.
        let next = ((2.0 * n - 1.0 + m - t) * polynomial - (n - 1.0 + m) * before) / n;
        (before, polynomial) = (polynomial, next);
        coefficient
    })
}

/// Threshold factor α at which ∫ P(y > αt) dG(t) equals the rate, with T in units of one cell's mean.
fn factor(cell: &CellPower, rate: f64, below: impl Fn(f64) -> f64) -> f64 {
    let grid = DiscretizedDistribution::new(rate, below);
    falling_root(rate, |factor| grid.false_alarm_rate(factor * cell.mean(), cell))
}

/// A discretised distribution: (t at the centre of a step, probability of the step).
struct DiscretizedDistribution {
    steps: Vec<(f64, f64)>,
}

impl DiscretizedDistribution {
    /// Divides a distribution, given by its cumulative function, into steps. The part below the grid passes
    /// with its own probability at most, the part above with less than the rate.
    fn new(rate: f64, below: impl Fn(f64) -> f64) -> Self {
        let (mut low, mut high) = (0.9, 1.1);
        while below(low) > 1e-5 * rate {
            low *= 0.9;
        }
        while below(high) < 1.0 - 1e-5 {
            high *= 1.1;
        }
        // About 30 steps per standard deviation: the midpoint rule errs by (αt·h)²/24 < 1e-3 at αt = 20.
        let ratio = (high / low).powf(1.0 / LEVELS as f64);
        let mut reached = 0.0;
        let step = |i: i32| {
            let t = low * ratio.powi(i);
            let now = if i == LEVELS { 1.0 } else { below(t) };
            let share = now - reached;
            reached = now;
            (t / ratio.sqrt(), share)
        };
        Self { steps: (0..=LEVELS).map(step).collect() }
    }

    fn false_alarm_rate(&self, factor: f64, cell: &CellPower) -> f64 {
        self.steps.iter().map(|(t, share)| cell.above(factor * t) * share).sum()
    }
}

const LEVELS: i32 = 256;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::detection::cfar_threshold::threshold_factor;
    use crate::numerics::incomplete_gamma::gamma_below;

    /// Quantile of the sum of M unit exponentials at this probability.
    fn quantile(channels: usize, probability: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        while gamma_below(channels, high) < probability {
            high *= 2.0;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if gamma_below(channels, middle) < probability { low = middle } else { high = middle }
        }
        high
    }

    fn independent(cells: f64, channels: usize) -> Vec<WeightedGamma> {
        let all = cells * channels as f64;
        vec![WeightedGamma { weight: 1.0 / all, shape: all }]
    }

    #[test]
    fn averages_of_independent_cells_return_the_closed_form() {
        for (cells, channels, rate) in
            [(16.0, 1, 1e-4), (248.0, 1, 1e-6), (71.6, 12, 1e-5), (248.0, 192, 1e-3)]
        {
            let (asked, got) = (
                threshold_factor(cells, channels, rate),
                ca_factor(&independent(cells, channels), &CellPower::of_channels(channels), rate),
            );
            assert!((got / asked - 1.0).abs() < 1e-8, "{cells} × {channels}: {got} against {asked}");
        }
    }

    #[test]
    fn ordered_statistics_of_one_channel_have_rohlings_factors() {
        let one = CellPower::of_channels(1);
        // Values of physics.md §8, k = ¾N, Pfa 1e-4 and 1e-6, printed to four decimals; the midpoint rule
        // keeps three more digits of the rate than of the factor.
        for (cells, at_1e4, at_1e6) in
            [(16, 11.0802, 20.9542), (32, 8.5801, 14.3985), (64, 7.5536, 11.9802), (128, 7.0855, 10.9292)]
        {
            for (rate, asked) in [(1e-4, at_1e4), (1e-6, at_1e6)] {
                let got = os_factor(cells, cells * 3 / 4, &one, rate);
                println!("{cells} cells at {rate:e}: {got:.5} against {asked}");
                assert!((got / asked - 1.0).abs() < 2e-4, "{cells} cells at {rate:e}: {got} against {asked}");
            }
        }
    }

    #[test]
    fn one_channel_of_two_halves_has_its_closed_form() {
        // Halves of one cell each: P(y > α·min) = 2/(2 + α)·…: min of two unit exponentials is exponential
        // with mean ½, so 1/(1 + α/2); and max = both less min: 2/(1 + α) − 1/(1 + α/2).
        let (half, one) = (independent(1.0, 1), CellPower::of_channels(1));
        for rate in [1e-2, 1e-4] {
            let smallest = so_factor([&half, &half], &one, rate);
            assert!((1.0 / (1.0 + 0.5 * smallest) / rate - 1.0).abs() < 1e-2, "{rate}: {smallest}");
            let greatest = go_factor([&half, &half], &one, rate);
            let got = 2.0 / (1.0 + greatest) - 1.0 / (1.0 + 0.5 * greatest);
            assert!((got / rate - 1.0).abs() < 1e-2, "{rate}: {greatest} gives {got}");
        }
    }

    #[test]
    fn coefficients_of_a_step_have_its_variance() {
        // Parseval: Σc_n² = u(1 − u); sixty terms of a jump's expansion retain most of it.
        for channels in [1, 12, 192] {
            let level = quantile(channels, 0.75);
            let sum: f64 = step_coefficients(channels, level).map(|c| c * c).sum();
            println!("{channels} channels: {sum} of 0.1875");
            assert!(sum < 0.1875 && sum > 0.1875 * 0.85, "{channels} channels: {sum}");
        }
    }
}
