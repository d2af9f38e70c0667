//! Root of a decreasing function: regula falsi in the Illinois form (Dowell, Jarratt, BIT 11 (1971) 168).

/// Finds the positive argument at which a decreasing function has this value: secants in logarithms within a
/// bracket (Illinois).
pub(crate) fn falling_root(value: f64, function: impl Fn(f64) -> f64) -> f64 {
    let error = |ln_x: f64| function(ln_x.exp()).max(f64::MIN_POSITIVE).ln() - value.ln();
    let (mut low, mut high) = (0.0, 0.5);
    let (mut at_low, mut at_high) = (error(low), error(high));
    while at_high > 0.0 {
        (low, at_low) = (high, at_high);
        high += 0.5;
        at_high = error(high);
    }
    while at_low < 0.0 {
        (high, at_high) = (low, at_low);
        low -= 0.5;
        at_low = error(low);
    }
    for _ in 0..100 {
        let next = (low * at_high - high * at_low) / (at_high - at_low);
        let at_next = error(next);
        if at_next.abs() < 1e-10 || high - low < 1e-12 {
            return next.exp();
        }
        if at_next > 0.0 {
            (low, at_low, at_high) = (next, at_next, 0.5 * at_high);
        } else {
            (high, at_high, at_low) = (next, at_next, 0.5 * at_low);
        }
    }
    (0.5 * (low + high)).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_has_its_root_however_far_from_one_it_lies() {
        for power in [0.5_f64, 3.0, 40.0] {
            for root in [1e-4_f64, 0.9, 700.0] {
                let got = falling_root(root.powf(-power), |x| x.powf(-power));
                // The search ends within 1e-10 of the function's logarithm, `power` times that of x, or at a
                // bracket 1e-12 wide.
                assert!((got / root - 1.0).abs() < 1.1e-10 / power + 1e-11, "{power}, {root}: {got}");
            }
        }
    }
}
