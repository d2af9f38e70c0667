//! Tapers of the map that `snr_db` refers to: periodic (N in the denominator), unit coherent gain
//! (conventions.md).

use artifact::settings::Window;
use num_complex::Complex64;
use rustfft::FftPlanner;
use std::f64::consts::TAU;

/// `length` weights whose mean is 1.
pub fn weights(window: Window, length: usize) -> Vec<f64> {
    let raw: Vec<f64> = match window {
        Window::Rect => vec![1.0; length],
        Window::Hann => cosine_sum(&[0.5, 0.5], length),
        Window::Hamming => cosine_sum(&[0.54, 0.46], length),
        Window::Blackman => cosine_sum(&[0.42, 0.5, 0.08], length),
        Window::Chebyshev(sidelobe_db) => dolph_chebyshev(sidelobe_db, length),
    };
    let mean = raw.iter().sum::<f64>() / length as f64;
    raw.iter().map(|w| w / mean).collect()
}

/// Equivalent noise bandwidth in cells, Σw²·N/(Σw)².
pub fn noise_bandwidth(weights: &[f64]) -> f64 {
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|w| w * w).sum::<f64>() * weights.len() as f64 / (sum * sum)
}

/// Σ (−1)^k·c_k·cos(2πkn/N).
fn cosine_sum(coefficients: &[f64], length: usize) -> Vec<f64> {
    let term = |n: usize, k: usize| {
        let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        sign * coefficients[k] * (TAU * (k * n) as f64 / length as f64).cos()
    };
    (0..length).map(|n| (0..coefficients.len()).map(|k| term(n, k)).sum()).collect()
}

/// Periodic Dolph–Chebyshev window: the symmetric one of `length` + 1 points without its last.
///
/// The symmetric window's spectrum is T_M(β·cos(πk/(M+1))), M = points − 1 (Dolph, Proc. IRE 34 (1946) 335);
/// here the window is summed from it with its centre at (M)/2, so that odd and even counts are one case.
fn dolph_chebyshev(sidelobe_db: f64, length: usize) -> Vec<f64> {
    let points = length + 1;
    let order = length as f64;
    let beta = ((10.0_f64.powf(sidelobe_db.abs() / 20.0)).acosh() / order).cosh();
    let half_turn = std::f64::consts::PI / points as f64;
    let mut spectrum: Vec<Complex64> = (0..points)
        .map(|k| {
            chebyshev(order, beta * (half_turn * k as f64).cos())
                * Complex64::cis(half_turn * (k * length) as f64)
        })
        .collect();
    FftPlanner::new().plan_fft_forward(points).process(&mut spectrum);
    spectrum.iter().take(length).map(|value| value.re).collect()
}

/// T_n(x) for whole n.
fn chebyshev(order: f64, x: f64) -> f64 {
    if x.abs() <= 1.0 {
        (order * x.acos()).cos()
    } else {
        let sign = if x < 0.0 && order % 2.0 != 0.0 { -1.0 } else { 1.0 };
        sign * (order * x.abs().acosh()).cosh()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn s3_noise_bandwidths_are_the_published_ones() {
        // physics.md §8, periodic windows; Blackman 1.727 (Harris, Proc. IEEE 66 (1978) 51, table 1: 1.73).
        for (window, expected) in [
            (Window::Rect, 1.0),
            (Window::Hann, 1.5),
            (Window::Hamming, 1.3628),
            (Window::Blackman, 1.7268),
            (Window::Chebyshev(80.0), 1.741),
        ] {
            let got = noise_bandwidth(&weights(window, 4096));
            // The table's figures have four digits, Chebyshev's depends on N in the fourth.
            assert!((got - expected).abs() < 1e-3, "{window:?}: {got} against {expected}");
        }
    }

    #[test]
    fn a_chebyshev_window_keeps_its_sidelobes_down_by_what_is_asked() {
        let (length, padded) = (64, 64 * 32);
        let mut spectrum: Vec<Complex64> =
            weights(Window::Chebyshev(80.0), length).iter().map(|&w| w.into()).collect();
        spectrum.push(spectrum[0]); // the point that makes it symmetric again
        spectrum.resize(padded, Complex64::ZERO);
        FftPlanner::new().plan_fft_forward(padded).process(&mut spectrum);
        let level = |k: usize| 20.0 * (spectrum[k].norm() / spectrum[0].norm()).log10();
        // The main lobe ends where T's argument falls to 1: cell (M+1)/π·acos(1/β) = 3.87 here, 124 of the
        // padded grid.
        let highest = (126..padded / 2).map(level).fold(f64::NEG_INFINITY, f64::max);
        assert!((highest + 80.0).abs() < 0.05, "{highest}");
    }
}
