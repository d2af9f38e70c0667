//! Regularised incomplete gamma functions P and Q, the distribution of a sum of M exponentials (Erlang; χ²/2
//! with 2M degrees of freedom).

/// Upper function P(G(M) > x) = Q(M, x) for integer M: e^{−x} Σ_{k<M} x^k/k!.
pub fn gamma_tail(shape: usize, x: f64) -> f64 {
    // Starting at the largest term would be safest; from k = 0 with a separate exponent nothing overflows
    // either.
    let (mut term, mut sum, mut scale) = (1.0_f64, 1.0_f64, -x);
    for k in 1..shape {
        term *= x / k as f64;
        sum += term;
        if sum > 1e200 {
            (term, sum, scale) = (term * 1e-200, sum * 1e-200, scale + 200.0 * std::f64::consts::LN_10);
        }
    }
    (sum.ln() + scale).exp()
}

/// Lower function P(G(M) < x) = P(M, x) for integer M, by the series of positive terms e^{−x} x^M/M!·(1 +
/// x/(M+1) + …), or as the complement of the tail.
pub(crate) fn gamma_below(shape: usize, x: f64) -> f64 {
    if x > shape as f64 + 1.0 {
        return 1.0 - gamma_tail(shape, x);
    }
    let ln_first = (1..=shape).map(|k| (x / k as f64).ln()).sum::<f64>() - x;
    let (mut term, mut sum, mut k) = (1.0, 1.0, shape as f64);
    while term > 1e-17 * sum {
        k += 1.0;
        term *= x / k;
        sum += term;
    }
    (ln_first + sum.ln()).exp()
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::function::gamma::gamma_lr;

    #[test]
    fn whole_shapes_agree_with_the_incomplete_gamma_function() {
        for shape in [1, 4, 12, 192] {
            for t in [0.2, 0.9, 1.1, 1.8] {
                let x = t * shape as f64;
                let asked = gamma_lr(shape as f64, x);
                assert!((gamma_below(shape, x) / asked - 1.0).abs() < 1e-10, "{shape}, {x}");
                assert!((gamma_tail(shape, x) + asked - 1.0).abs() < 1e-11, "{shape}, {x}");
            }
        }
    }
}
