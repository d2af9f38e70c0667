//! Student's distribution, of the mean of few normal values with unknown spread. Closed form for whole
//! degrees of freedom: Abramowitz and Stegun, 26.7.3 and 26.7.4.

/// Degrees of freedom from which the normal distribution's quantile suffices: the difference is z(z² + 1)/4ν,
/// 2e-6 at z = 2.
const NORMAL: usize = 1_000_000;

/// Quantile t, in standard errors from the mean, within which a share `confidence` of the values lies, from 0
/// to below 1, with `freedom` degrees of freedom, at least 1.
pub(crate) fn two_sided(confidence: f64, freedom: usize) -> f64 {
    let freedom = freedom.clamp(1, NORMAL);
    let (mut low, mut high) = (0.0, std::f64::consts::FRAC_PI_2);
    // Bisection in the angle atan(t/√ν), which is bounded: 60 halvings give more digits than a double has.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match within(middle, freedom) < confidence {
            true => low = middle,
            false => high = middle,
        }
    }
    low.tan() * (freedom as f64).sqrt()
}

/// Share of the values between −t and t, t = √ν tan(angle).
fn within(angle: f64, freedom: usize) -> f64 {
    let (sin, cos) = angle.sin_cos();
    match freedom % 2 {
        1 if freedom == 1 => angle * std::f64::consts::FRAC_2_PI,
        1 => (angle + sin * series(cos, cos, 2.0, freedom - 3)) * std::f64::consts::FRAC_2_PI,
        _ => sin * series(1.0, cos, 1.0, freedom - 2),
    }
}

/// Sum of `first` and the terms after it, each cos²·k/(k + 1) of the one before, k = `from`, `from` + 2, …,
/// one for each even number up to `last`; ends when no digit changes.
fn series(first: f64, cos: f64, from: f64, last: usize) -> f64 {
    let (mut term, mut sum) = (first, first);
    for number in 0..last / 2 {
        let k = from + 2.0 * number as f64;
        term *= cos * cos * k / (k + 1.0);
        sum += term;
        if term < 1e-18 * sum {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_one_two_and_four_degrees_of_freedom_are_those_of_their_closed_forms() {
        for confidence in [0.5, 0.9, 0.95, 0.999] {
            let p = 0.5 * (1.0 + confidence);
            let one = (std::f64::consts::PI * (p - 0.5)).tan();
            let two = (2.0 * p - 1.0) / (2.0 * p * (1.0 - p)).sqrt();
            let alpha = (4.0 * p * (1.0 - p)).sqrt();
            let four = 2.0 * ((alpha.acos() / 3.0).cos() / alpha - 1.0).sqrt();
            for (freedom, expected) in [(1, one), (2, two), (4, four)] {
                let found = two_sided(confidence, freedom);
                assert!((found / expected - 1.0).abs() < 1e-9, "{freedom} {confidence}: {found} {expected}");
            }
        }
    }

    #[test]
    fn quantiles_are_those_of_the_tables() {
        // Abramowitz and Stegun, table 26.10, two-sided 95 %; and the normal distribution's.
        for (freedom, expected) in
            [(3, 3.182_446_3), (5, 2.570_581_8), (10, 2.228_138_9), (30, 2.042_272_5), (1 << 20, 1.959_966)]
        {
            let found = two_sided(0.95, freedom);
            assert!((found - expected).abs() < 1e-6, "{freedom}: {found} {expected}");
        }
    }
}
