//! Tapers of the FFT axes: periodic (N, not N − 1, in the denominator) and of unit coherent gain (mean 1).

use artifact::settings::Window;
use artifact::units::amplitude_from_db;
use num_complex::Complex64;
use rustfft::FftPlanner;
use std::f64::consts::{PI, TAU};

/// Error of a Dolph–Chebyshev window with a sidelobe level that no FFT axis can use.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("a Chebyshev window has sidelobes from 10 to 300 dB below its peak, not {0}")]
pub struct Sidelobes(
    /// Requested sidelobe level, dB.
    pub f64,
);

/// Weights of a window over `length` samples, with mean 1, so that a tone of amplitude A at a bin centre
/// yields |A|·N.
pub fn taper(window: Window, length: usize) -> Result<Vec<f64>, Sidelobes> {
    let raw = match window {
        Window::Rect => vec![1.0; length],
        Window::Hann => cosine_sum(&[0.5, 0.5], length),
        Window::Hamming => cosine_sum(&[0.54, 0.46], length),
        // The "not very serious proposal" of Blackman & Tukey (1958), §B.5.
        Window::Blackman => cosine_sum(&[0.42, 0.5, 0.08], length),
        Window::Chebyshev(sidelobe_db) => dolph_chebyshev(sidelobe_db, length)?,
    };
    let mean = raw.iter().sum::<f64>() / length as f64;
    // Short tapers can vanish (Hann of one sample) and then cannot be normalised; they are replaced by flat
    // ones.
    Ok(if mean > 0.0 { raw.iter().map(|w| w / mean).collect() } else { vec![1.0; length] })
}

/// Equivalent noise bandwidth in bins: N·Σw²/(Σw)² (Harris, Proc. IEEE 66 (1978) 51, eq. 11).
pub fn noise_bandwidth_bins(taper: &[f64]) -> f64 {
    let sum: f64 = taper.iter().sum();
    let energy: f64 = taper.iter().map(|w| w * w).sum();
    taper.len() as f64 * energy / (sum * sum)
}

/// Cells over which the noise power of one cell is spread by a window, Σ|ρ|² over all lags of the complex
/// correlation ρ: N·Σw⁴/(Σw²)² by Parseval. The mean power of n neighbouring cells varies like that of n over
/// this number of independent ones.
pub fn correlated_bins(taper: &[f64]) -> f64 {
    let energy: f64 = taper.iter().map(|w| w * w).sum();
    let fourth: f64 = taper.iter().map(|w| w.powi(4)).sum();
    taper.len() as f64 * fourth / (energy * energy)
}

/// W(δ) = Σ wₙ e^{j2πδn/N}: response of a cell to a tone δ cells above its centre.
pub fn transform(taper: &[f64], offset_bins: f64) -> Complex64 {
    let step = TAU * offset_bins / taper.len() as f64;
    taper.iter().enumerate().map(|(n, w)| Complex64::from_polar(*w, step * n as f64)).sum()
}

/// W(δ) of [`transform`] at δ = 0, 1/n, 2/n … cells over the whole axis, for n steps per cell.
pub fn fine_transform(taper: &[f64], steps_per_bin: usize) -> Vec<Complex64> {
    let mut values: Vec<Complex64> = taper.iter().map(|w| (*w).into()).collect();
    values.resize(taper.len() * steps_per_bin, Complex64::ZERO);
    FftPlanner::new().plan_fft_inverse(values.len()).process(&mut values);
    values
}

/// Noise correlation |ρ|² between two cells `lag_bins` apart, which for white samples is that of the squared
/// window.
pub fn noise_correlation(taper: &[f64], lag_bins: f64) -> f64 {
    let squared: Vec<f64> = taper.iter().map(|w| w * w).collect();
    let energy: f64 = squared.iter().sum();
    response(&squared, lag_bins) * (taper.len() as f64 / energy).powi(2)
}

/// Power response of a cell to a tone `offset_bins` from its centre, 1 at the centre.
fn response(taper: &[f64], offset_bins: f64) -> f64 {
    transform(taper, offset_bins).norm_sqr() / (taper.len() as f64).powi(2)
}

/// Σ (−1)^k a_k cos(2πkn/N).
fn cosine_sum(coefficients: &[f64], length: usize) -> Vec<f64> {
    let weight = |n: usize| -> f64 {
        let angle = TAU * n as f64 / length as f64;
        let terms = coefficients.iter().enumerate().map(|(k, a)| (k as f64 * angle).cos() * a);
        terms.enumerate().map(|(k, term)| if k % 2 == 0 { term } else { -term }).sum()
    };
    (0..length).map(weight).collect()
}

/// Dolph (Proc. IRE 34 (1946) 335): after a zero, the symmetric window of N − 1 points whose spectrum is the
/// Chebyshev polynomial of degree N − 2.
///
/// The zero makes it periodic, as that of Hann's window does, and has no effect on its sidelobes, which are
/// all at the requested level. The symmetric window of N + 1 points without its last would miss the level by
/// that point: 4 dB of 80 at N = 256, 6 dB at 64.
fn dolph_chebyshev(sidelobe_db: f64, length: usize) -> Result<Vec<f64>, Sidelobes> {
    if !(10.0..=300.0).contains(&sidelobe_db) {
        return Err(Sidelobes(sidelobe_db));
    }
    let Some(points) = length.checked_sub(1).filter(|points| *points > 1) else {
        return Ok(vec![1.0; length]);
    };
    let degree = (points - 1) as f64;
    let stretch = (amplitude_from_db(sidelobe_db).acosh() / degree).cosh();
    let spectrum = |k: usize| {
        let angle = PI * k as f64 / points as f64;
        // The first factor puts the middle of the points at their index degree/2.
        Complex64::from_polar(1.0, angle * degree) * chebyshev(degree, stretch * angle.cos())
    };
    let mut weights: Vec<Complex64> = (0..points).map(spectrum).collect();
    FftPlanner::new().plan_fft_forward(points).process(&mut weights);
    Ok(std::iter::once(0.0).chain(weights.iter().map(|w| w.re)).collect())
}

/// T_n(x) of integer degree n.
fn chebyshev(degree: f64, x: f64) -> f64 {
    let sign = if x < 0.0 && degree % 2.0 != 0.0 { -1.0 } else { 1.0 };
    let x = x.abs();
    sign * if x <= 1.0 { (degree * x.acos()).cos() } else { (degree * x.acosh()).cosh() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Window; 5] =
        [Window::Rect, Window::Hann, Window::Hamming, Window::Blackman, Window::Chebyshev(80.0)];

    #[test]
    fn s3_noise_bandwidths_are_those_of_the_windows() {
        // physics.md §8: periodic windows; the closed forms of the cosine sums are Σa²-ratios and hold for
        // any N > 4.
        for (window, bins) in [
            (Window::Rect, 1.0),
            (Window::Hann, 1.5),
            (Window::Hamming, 1.0 + 0.5 * (0.46_f64 / 0.54).powi(2)),
            (Window::Blackman, 1.0 + 0.5 * (0.5_f64.powi(2) + 0.08_f64.powi(2)) / 0.42_f64.powi(2)),
        ] {
            for length in [128, 255, 512] {
                let got = noise_bandwidth_bins(&taper(window, length).unwrap());
                assert!((got - bins).abs() < 1e-12, "{window:?} of {length}: {got} against {bins}");
            }
        }
        assert!((noise_bandwidth_bins(&taper(Window::Hamming, 256).unwrap()) - 1.363).abs() < 5e-4);
    }

    #[test]
    fn correlated_cells_are_the_sum_of_squared_correlations() {
        for window in ALL {
            let taper = taper(window, 96).unwrap();
            let of_lags: f64 = (0..96).map(|lag| noise_correlation(&taper, f64::from(lag))).sum();
            let got = correlated_bins(&taper);
            assert!((got - of_lags).abs() < 1e-12 * got, "{window:?}: {got} against {of_lags}");
        }
        let hann = correlated_bins(&taper(Window::Hann, 96).unwrap());
        assert!((hann - 35.0 / 18.0).abs() < 1e-12, "Σcos⁸ over (Σcos⁴)²: {hann}");
    }

    #[test]
    fn every_window_has_unit_coherent_gain_for_odd_even_and_tiny_lengths() {
        for window in ALL {
            for length in [1, 2, 3, 7, 64, 101] {
                let weights = taper(window, length).unwrap();
                let mean = weights.iter().sum::<f64>() / length as f64;
                assert!((mean - 1.0).abs() < 1e-12, "{window:?} of {length}: mean {mean}");
                assert!(weights.iter().all(|w| w.is_finite()));
            }
        }
    }

    #[test]
    fn windows_are_periodic_their_middle_lies_at_n_half() {
        for window in ALL {
            for length in [16, 17] {
                let weights = taper(window, length).unwrap();
                for n in 1..length {
                    assert!(
                        (weights[n] - weights[length - n]).abs() < 1e-12,
                        "{window:?} of {length} at {n}"
                    );
                }
            }
        }
    }

    #[test]
    fn noise_of_hann_cells_correlates_over_two_neighbours_only() {
        // Autocorrelation of the kernel (−1/4, 1/2, −1/4): 3/8, −1/4, 1/16, 0.
        let hann = taper(Window::Hann, 64).unwrap();
        for (lag, rho) in [(0.0, 1.0), (1.0, -2.0 / 3.0), (2.0, 1.0 / 6.0), (3.0, 0.0), (4.0, 0.0)] {
            let rho: f64 = rho;
            assert!((noise_correlation(&hann, lag) - rho * rho).abs() < 1e-14, "lag {lag}");
        }
    }

    #[test]
    fn chebyshev_sidelobes_outside_a_sensible_range_are_refused() {
        for level in [f64::NAN, -80.0, 0.0, 1e9] {
            assert!(taper(Window::Chebyshev(level), 64).is_err());
        }
    }

    /// Highest level beyond the main lobe, dB below the peak.
    fn highest_sidelobe_db(taper: &[f64]) -> f64 {
        let fine = fine_transform(taper, 64);
        let level = |value: &Complex64| 20.0 * (value.norm() / fine[0].norm()).log10();
        let half = &fine[..fine.len() / 2];
        let null = half.windows(2).position(|pair| pair[1].norm() > pair[0].norm()).unwrap();
        half[null..].iter().map(level).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The window as maps use it, at all places between cells.
    #[test]
    fn a_chebyshev_window_keeps_its_sidelobes_down_by_what_is_asked() {
        for length in [16, 64, 101, 256] {
            for asked_db in [20.0, 30.0, 40.0, 60.0, 80.0, 120.0] {
                let got_db = highest_sidelobe_db(&taper(Window::Chebyshev(asked_db), length).unwrap());
                // Steps of 1/64 cell miss the maximum of a lobe of one cell by (π/128)²/2, 3e-4 of it.
                assert!((got_db + asked_db).abs() < 0.02, "{length} points, {asked_db} dB: {got_db}");
            }
        }
    }

    #[test]
    fn the_fine_transform_is_the_transform_at_each_of_its_steps() {
        let weights = taper(Window::Hamming, 13).unwrap();
        for (step, value) in fine_transform(&weights, 8).into_iter().enumerate() {
            assert!((value - transform(&weights, step as f64 / 8.0)).norm() < 1e-12, "{step}");
        }
    }
}
