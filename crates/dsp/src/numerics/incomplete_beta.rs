//! Regularised incomplete beta function I_u(a, b), the distribution of an ordered statistic and of ratios of
//! Gamma variables (Fisher's F).
//!
//! I_u(a, b) = u^a(1 − u)^b/(a·B(a, b)) · 1/(1 + d₁/(1 + d₂/(1 + …))) (DLMF 8.17.22). The fraction converges
//! quickly below the mean, in about √max(a, b) terms at it; above it the complement is used, 1 − I_{1−u}(b,
//! a).

use std::f64::consts::TAU;

/// Regularised incomplete beta function I_u(a, b): P(A/(A + B) < u) for Gamma variables of these shapes.
pub(crate) fn beta_below(a: f64, b: f64, u: f64) -> f64 {
    if u <= 0.0 {
        return 0.0;
    }
    if u >= 1.0 {
        return 1.0;
    }
    // 1 − u is exact from ½ up, where it is small.
    if u < (a + 1.0) / (a + b + 2.0) {
        lower([a, b], [u, 1.0 - u])
    } else {
        1.0 - lower([b, a], [1.0 - u, u])
    }
}

/// I_u(a, b) from [u, 1 − u], for u below the mean or little above it.
fn lower([a, b]: [f64; 2], [u, rest]: [f64; 2]) -> f64 {
    ln_power([a, b], [u, rest]).exp() * (a * b / (TAU * (a + b))).sqrt() / a * fraction([a, b], u)
}

/// Logarithm of u^a(1 − u)^b/B(a, b) over √(ab/2π(a + b)).
///
/// By Stirling's formula the powers and the large terms of the Gamma functions cancel before rounding, and
/// their deviations remain (Loader, Fast and accurate computation of binomial probabilities (2000)).
fn ln_power([a, b]: [f64; 2], [u, rest]: [f64; 2]) -> f64 {
    let sum = a + b;
    stirling_error(sum)
        - stirling_error(a)
        - stirling_error(b)
        - deviance(a, sum * u)
        - deviance(b, sum * rest)
}

/// Deviance x·ln(x/m) + m − x, at least zero.
fn deviance(x: f64, mean: f64) -> f64 {
    let part = (mean - x) / x;
    // Near the mean the difference is exact, and far below it the ratio keeps its digits.
    x * (part - if part > -0.5 { part.ln_1p() } else { (mean / x).ln() })
}

/// Relative error of Stirling's formula, ln Γ(z) − (z − ½)ln z + z − ½ln 2π: by its series from 10 on, below
/// by recursion in steps of one.
fn stirling_error(mut z: f64) -> f64 {
    let mut steps = 0.0;
    while z < 10.0 {
        steps += (z + 0.5) * (1.0 / z).ln_1p() - 1.0;
        z += 1.0;
    }
    // B₂ₙ/(2n(2n − 1)z^{2n−1}), n = 1 … 6; the next, 1/156z¹³, is 6e-16 at most.
    const SERIES: [f64; 6] =
        [1.0 / 12.0, -1.0 / 360.0, 1.0 / 1260.0, -1.0 / 1680.0, 1.0 / 1188.0, -691.0 / 360_360.0];
    steps + SERIES.iter().rev().fold(0.0, |sum, term| sum / (z * z) + term) / z
}

/// Maximum number of terms of the fraction: √max(a, b) of 10¹⁰.
const MOST_TERMS: u32 = 100_000;

/// Continued fraction 1/(1 + d₁/(1 + …)), evaluated forwards by Lentz's recurrence in Thompson and Barnett's
/// form (J. Comput. Phys. 64 (1986) 490).
fn fraction([a, b]: [f64; 2], u: f64) -> f64 {
    let kept = |x: f64| if x == 0.0 { f64::MIN_POSITIVE } else { x };
    let (mut above, mut below) = (1.0, 1.0 / kept(1.0 - (a + b) * u / (a + 1.0)));
    let mut value = below;
    for m in 1..MOST_TERMS {
        let m = f64::from(m);
        let at = a + 2.0 * m;
        let even = m * (b - m) * u / ((at - 1.0) * at);
        let odd = -(a + m) * (a + b + m) * u / (at * (at + 1.0));
        let mut change = 1.0;
        for term in [even, odd] {
            below = 1.0 / kept(1.0 + term * below);
            above = kept(1.0 + term / above);
            change = above * below;
            value *= change;
        }
        if (change - 1.0).abs() < f64::EPSILON {
            break;
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::function::beta::beta_reg;

    /// I_u(a, b) for integer a and b and its complement, P(K ≥ a) and P(K < a) for K successes in a + b − 1
    /// trials: sums of positive terms from P(K = a) on; `None` if that is not a normal number.
    fn exact(a: u32, b: u32, u: f64) -> Option<[f64; 2]> {
        let trials = a + b - 1;
        let first = probability(a, b, u);
        let odds = u / (1.0 - u);
        let (mut upper, mut term) = (0.0, first);
        for k in a..=trials {
            upper += term;
            term *= odds * f64::from(trials - k) / f64::from(k + 1);
        }
        let (mut below, mut term) = (0.0, first);
        for k in (1..=a).rev() {
            term *= f64::from(k) / (odds * f64::from(trials + 1 - k));
            below += term;
        }
        (first > 1e-290).then_some([upper, below])
    }

    /// C(a + b − 1, a)·u^a·(1 − u)^{b−1}, factor by factor: a large one while the product is small, one
    /// rounding each.
    fn probability(a: u32, b: u32, u: f64) -> f64 {
        let fewer = a.min(b - 1);
        let mut large = (1..=fewer).map(|k| f64::from(a + b - 1 - fewer + k) / f64::from(k));
        let small = (0..a).map(|_| u).chain((1..b).map(|_| 1.0 - u));
        let with_large = |product: f64, part: f64| {
            let product = product * part;
            if product < 1.0 { large.next().map_or(product, |more| product * more) } else { product }
        };
        let product = small.fold(1.0, with_large);
        large.fold(product, |product, more| product * more)
    }

    #[test]
    fn a_difference_of_two_has_the_incomplete_beta_function() {
        for (a, b) in [(1.0, 1.0), (6.0, 3.0), (54.3, 18.2), (186.0, 63.0)] {
            for u in [0.05, 0.4, 0.6, 0.75, 0.9] {
                let (asked, got) = (beta_reg(a, b, u), beta_below(a, b, u));
                assert!(
                    (got - asked).abs() < 1e-9 * asked + 1e-13,
                    "{a}, {b}, {u}: {got:e} against {asked:e}"
                );
            }
        }
    }

    #[test]
    fn whole_shapes_have_the_tails_of_the_binomial_distribution_on_both_sides_of_the_mean() {
        let shapes = [(1, 1), (1, 40), (6, 3), (12, 859), (859, 12), (186, 63), (2976, 12), (5000, 5000)];
        let mut worst = 0.0_f64;
        let mut tried = 0;
        for (a, b) in shapes {
            for tenths in -80..=80 {
                // Odds over decades around those of the mean.
                let odds = f64::from(a) / f64::from(b) * 10_f64.powf(f64::from(tenths) / 20.0);
                let u = odds / (1.0 + odds);
                let Some(asked) = exact(a, b, u) else { continue };
                let got = [beta_below(a.into(), b.into(), u), beta_below(b.into(), a.into(), 1.0 - u)];
                // A rounding of u changes each trial's probability, in the sums as in the function.
                let rounding = f64::from(a + b) * f64::EPSILON;
                tried += 1;
                for (asked, got) in asked.into_iter().zip(got) {
                    worst = worst.max((got / asked - 1.0).abs() / rounding);
                    assert!(
                        (got / asked - 1.0).abs() < 8.0 * rounding + 1e-14,
                        "{a}, {b}, {u}: {got:e} against {asked:e}"
                    );
                }
            }
        }
        println!("{tried} points, at most {worst:.2} of (a + b)·ε");
        assert!(tried > 600);
    }

    #[test]
    fn far_above_the_mean_of_lopsided_shapes_it_is_less_than_one() {
        // Σ C(n, k)u^k(1 − u)^{n−k} over k ≥ a in integers, rounded once.
        for (a, b, u, exact) in [
            (859.0, 12.0, 0.97, 6.407_441_916_335_293e-4),
            (859.0, 12.0, 0.995, 0.998_225_972_755_854_6),
            (2976.0, 12.0, 0.999, 0.999_932_287_706_570_2),
        ] {
            let got = beta_below(a, b, u);
            assert!((got / exact - 1.0).abs() < (a + b) * f64::EPSILON, "{a}, {b}, {u}: {got}");
        }
    }
}
