//! Interpolation of a smooth function of frequency from few points over a band: number of points, their
//! positions, and the polynomial through them.
//!
//! n points of the second kind match f(x)e^{jθx} on [−1, 1], f analytic and |f| ≤ 1 in an ellipse with half
//! axes (ρ ± 1/ρ)/2 around it, to 4e^{θ(ρ − 1/ρ)/2}ρ^{1−n}/(ρ − 1), for any ρ (Trefethen, Approximation
//! Theory and Approximation Practice (2013), theorem 8.2). n points of the first kind match a sum of
//! exponentials e^{jtx}, |t| ≤ θ, whose magnitudes add up to 1, to θⁿ/(n!·2ⁿ⁻¹): its n-th derivative is at
//! most θⁿ, and their node polynomial stays below 2¹⁻ⁿ.

use std::f64::consts::PI;

/// Chebyshev points over a band of wavenumbers.
pub(crate) struct Chebyshev {
    /// Wavenumbers of the points, highest first.
    pub(crate) nodes_per_m: Vec<f64>,
    /// Barycentric weights.
    weights: Vec<f64>,
}

/// Smallest number of points, below `limit`, that match a phase rotation of θ over half the band to an error
/// relative to the amplitude, for an ellipse with ρ ≤ `most`; `None` if there is none.
pub(crate) fn points(turn_rad: f64, most: f64, error: f64, limit: usize) -> Option<usize> {
    (2..limit).find(|count| in_ellipse(*count as u32, turn_rad, most) <= error)
}

/// Error of `count` points of the second kind for a phase rotation of θ over half the band, for an ellipse
/// with ρ ≤ `most`.
fn in_ellipse(count: u32, turn_rad: f64, most: f64) -> f64 {
    // Without the limit ρ = 2n/θ is best; the logarithm does not overflow. No rotation at all is 0 or −0.
    let rho = most.min(2.0 * f64::from(count) / turn_rad.abs());
    let power = 0.5 * turn_rad * (rho - 1.0 / rho) - f64::from(count - 1) * rho.ln();
    if rho > 1.0 { (power + (4.0 / (rho - 1.0)).ln()).exp() } else { f64::INFINITY }
}

/// Largest θ that `count` points of the second kind match to an error for an ellipse with ρ ≤ `most`; 0 if
/// there is none.
pub(crate) fn turn_in_ellipse_rad(count: usize, most: f64, error: f64) -> f64 {
    let (mut low, mut high) = (0.0, count as f64);
    for _ in 0..TURN_HALVINGS {
        let middle = 0.5 * (low + high);
        *(if in_ellipse(count as u32, middle, most) <= error { &mut low } else { &mut high }) = middle;
    }
    low
}

/// Number of bisections, which give θ to a thousandth.
const TURN_HALVINGS: usize = 16;

/// Largest θ at which `count` points of the first kind match sums of exponentials to an error:
/// (error·n!·2ⁿ⁻¹)^{1/n}.
pub(crate) fn turn_of_exponentials_rad(count: usize, error: f64) -> f64 {
    let logarithm: f64 = (1..=count).map(|i| (2.0 * i as f64).ln()).sum();
    ((logarithm - 2.0_f64.ln() + error.ln()) / count as f64).exp()
}

/// Centre and half width of a band; `None` for fewer than two wavenumbers.
pub(crate) fn middle_and_half(wavenumbers_per_m: &[f64]) -> Option<(f64, f64)> {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let [low, high] = wavenumbers_per_m.iter().fold(start, |[low, high], &k| [low.min(k), high.max(k)]);
    (low < high).then_some((0.5 * (low + high), 0.5 * (high - low)))
}

impl Chebyshev {
    /// `count` points of the first kind over the band middle ± half.
    pub(crate) fn of_first_kind(middle: f64, half: f64, count: usize) -> Self {
        let angle = |i: usize| PI * (i as f64 + 0.5) / count as f64;
        let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        Self {
            nodes_per_m: (0..count).map(|i| middle + half * angle(i).cos()).collect(),
            weights: (0..count).map(|i| sign(i) * angle(i).sin()).collect(),
        }
    }

    /// `count` (two or more) points of the second kind over the band middle ± half, including its ends.
    pub(crate) fn over(middle: f64, half: f64, count: usize) -> Self {
        let angle = |i: usize| PI * i as f64 / (count - 1) as f64;
        let mut nodes_per_m: Vec<f64> = (0..count).map(|i| middle + half * angle(i).cos()).collect();
        nodes_per_m[0] = middle + half;
        let end = |i: usize| if i == 0 || i == count - 1 { 0.5 } else { 1.0 };
        let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        Self { nodes_per_m, weights: (0..count).map(|i| sign(i) * end(i)).collect() }
    }

    /// Calls `give` with every point and its weight in the polynomial's value at `wavenumber_per_m`
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Worst error of e^{jtx} at the points of a band around zero, on a line, for phase rotations t from −θ
    /// to θ.
    fn worst(points: &Chebyshev, turn_rad: f64) -> f64 {
        let error = |turn: f64, x: f64| {
            let mut sum = [0.0; 2];
            points.shares(x, |i, share| {
                let (sin, cos) = (turn * points.nodes_per_m[i]).sin_cos();
                sum = [sum[0] + share * cos, sum[1] + share * sin];
            });
            (sum[0] - (turn * x).cos()).hypot(sum[1] - (turn * x).sin())
        };
        let steps = || (-20..=20).map(|i| f64::from(i) / 20.0);
        steps().flat_map(|t| steps().map(move |x| error(t * turn_rad, x))).fold(0.0, f64::max)
    }

    /// The sum over no layers is −0.
    #[test]
    fn what_does_not_turn_takes_two_points_and_what_turns_too_far_none() {
        for no_turn in [0.0, -0.0, std::iter::empty::<f64>().sum()] {
            assert_eq!(points(no_turn, 250.0, 1e-3, 64), Some(2));
        }
        assert_eq!(points(1e3, 250.0, 1e-3, 64), None);
        assert_eq!(points(0.0, 250.0, 1e-3, 2), None);
    }

    #[test]
    fn points_meet_the_turn_that_they_are_said_to_over_ten_decades() {
        for decade in 1..=10 {
            let asked = 10_f64.powi(-decade);
            for count in [2, 3, 5, 8, 16] {
                let turn_rad = turn_of_exponentials_rad(count, asked);
                let got = worst(&Chebyshev::of_first_kind(0.0, 1.0, count), turn_rad);
                let turn_ellipse_rad = turn_in_ellipse_rad(count, f64::INFINITY, asked);
                let got_ellipse = worst(&Chebyshev::over(0.0, 1.0, count), turn_ellipse_rad);
                println!(
                    "{count} points, asked {asked:.0e}: {turn_rad:.3} rad {got:.1e}, {turn_ellipse_rad:.3} rad {got_ellipse:.1e}"
                );
                assert!(got <= asked + 1e-14 && got_ellipse <= asked + 1e-14);
                // The bound of a small rotation is nearly reached: there are no more points than needed.
                assert!(turn_rad > 3.0 || got > 0.7 * asked);
            }
        }
    }
}
