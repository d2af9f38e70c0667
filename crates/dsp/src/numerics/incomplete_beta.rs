//! The regularised incomplete beta function I_u(a, b), distribution of an ordered statistic and of ratios of
//! Gamma variables (Fisher's F).

use crate::numerics::saddle_point_inversion::{WeightedGamma, probability_below};

/// I_u(a, b), the regularised incomplete beta function: A/(A + B) < u is (1 − u)A − uB < 0.
pub(crate) fn beta_below(a: f64, b: f64, u: f64) -> f64 {
    if u <= 0.0 {
        return 0.0;
    }
    if u >= 1.0 {
        return 1.0;
    }
    let form = [WeightedGamma { weight: 1.0 - u, shape: a }, WeightedGamma { weight: -u, shape: b }];
    probability_below(&form, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::function::beta::beta_reg;

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
}
