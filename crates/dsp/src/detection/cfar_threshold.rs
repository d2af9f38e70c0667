//! Threshold factor of cell averaging over M summed channels.
//!
//! The cell under test is a sum of M unit exponentials (square law), the training sum one of N·M: their ratio
//! gives P_fa = I_x(NM, M) with x = N/(N + α), the regularised incomplete beta function (`docs/physics.md`
//! §8; Richards, Fundamentals of Radar Signal Processing, 2014, §6.5; M = 1 yields α = N(P_fa^{−1/N} − 1)).

/// Finds the factor α on the mean of the training cells that noise exceeds with probability
/// `false_alarm_rate`.
///
/// `training_cells` is the number of independent cells, not necessarily an integer; `false_alarm_rate` lies
/// in (0, 1).
pub(crate) fn threshold_factor(training_cells: f64, channels: usize, false_alarm_rate: f64) -> f64 {
    if channels == 1 {
        // expm1 keeps the digits that N(p^{−1/N} − 1) would lose at large N.
        return training_cells * (-false_alarm_rate.ln() / training_cells).exp_m1();
    }
    let asked = false_alarm_rate.ln();
    let mut low = 0.0;
    let mut high = 1.0;
    while ln_false_alarm_rate(high, training_cells, channels) > asked {
        low = high;
        high *= 2.0;
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if ln_false_alarm_rate(middle, training_cells, channels) > asked {
            low = middle
        } else {
            high = middle
        }
    }
}

/// Logarithm of the false-alarm rate, ln I_x(NM, M): for integer M the incomplete beta function is the finite
/// sum x^a Σ_{k<M} C(a+k−1, k)(1−x)^k, a = NM; every term is positive, so nothing cancels, and a may be any
/// positive number.
fn ln_false_alarm_rate(factor: f64, training_cells: f64, channels: usize) -> f64 {
    let a = training_cells * channels as f64;
    let beyond = factor / (training_cells + factor);
    let (mut term, mut sum, mut scale) = (1.0, 1.0, 0.0);
    for k in 0..channels - 1 {
        term *= (a + k as f64) / (k + 1) as f64 * beyond;
        sum += term;
        if sum > LARGE {
            (term, sum, scale) = (term / LARGE, sum / LARGE, scale + LARGE.ln());
        }
    }
    -a * (factor / training_cells).ln_1p() + sum.ln() + scale
}

/// Value at which partial sums are rescaled, far from overflow (1.8e308).
const LARGE: f64 = 1e200;

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::function::beta::beta_reg;

    #[test]
    fn s1_threshold_factors_are_those_of_the_table() {
        // Values of physics.md §8, Pfa 1e-4 and 1e-6, printed to four decimals.
        for (cells, at_1e4, at_1e6) in [
            (16.0, 12.4525, 21.9420),
            (32.0, 10.6727, 17.2776),
            (64.0, 9.9060, 15.4200),
            (128.0, 9.5498, 14.5887),
        ] {
            assert!((threshold_factor(cells, 1, 1e-4) - at_1e4).abs() < 1e-4);
            assert!((threshold_factor(cells, 1, 1e-6) - at_1e6).abs() < 1e-4);
        }
    }

    #[test]
    fn the_sum_of_channels_obeys_the_incomplete_beta_function() {
        for channels in [2, 3, 12, 48, 192] {
            for cells in [3.0, 16.0, 71.6, 248.0] {
                for rate in [1e-2, 1e-4, 1e-6] {
                    let factor = threshold_factor(cells, channels, rate);
                    let (a, b) = (cells * channels as f64, channels as f64);
                    let got = beta_reg(a, b, cells / (cells + factor));
                    // The reference exponentiates ln Γ(48 000) ≈ 5e5, so its relative error is 5e5·1e-15.
                    assert!(
                        (got / rate - 1.0).abs() < 1e-8,
                        "{channels} channels, {cells} cells: {got:e} for {rate:e}"
                    );
                }
            }
        }
    }

    #[test]
    fn one_channel_is_the_limit_of_the_general_sum() {
        for cells in [5.0, 248.0] {
            let factor = threshold_factor(cells, 1, 1e-5);
            assert!((ln_false_alarm_rate(factor, cells, 1) - 1e-5_f64.ln()).abs() < 1e-12);
        }
    }

    #[test]
    fn more_channels_need_a_lower_factor_and_rarer_alarms_a_higher_one() {
        assert!(threshold_factor(100.0, 4, 1e-5) < threshold_factor(100.0, 2, 1e-5));
        assert!(threshold_factor(100.0, 4, 1e-6) > threshold_factor(100.0, 4, 1e-5));
    }
}
