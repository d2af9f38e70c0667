//! Interpolation of a peak between cells: from the complex values of three cells, by inverting the window's
//! own response.
//!
//! A tone at offset δ from a cell leaves W(δ − m) in the cell m steps away, W the transform of the window.
//! The ratio q = Re (X₋₁ − X₊₁)/X₀ grows with δ for every window (rect: 2δ/(1 − δ²), Hann: 6δ/(4 − δ²));
//! unlike a parabola through log powers, which for rect carries no information near a cell's centre, it uses
//! the phase and is unbiased (Jacobsen and Kootsookos, IEEE Signal Processing Magazine 24 (2007) 123, and
//! Candan, IEEE Signal Processing Letters 18 (2011) 351, for rect and Hann). The curve is tabulated once per
//! window and inverted.

use crate::spectrum::window::transform;
use num_complex::Complex64;

/// Estimates offsets from values for one window and axis.
pub(crate) struct Interpolator {
    /// Ratio q of a tone at each of the offsets.
    ratios: Vec<f64>,
}

/// Values of one channel in the cell before a peak, at the peak, and after it.
pub(crate) type Trio = [Complex64; 3];

/// Number of tabulated offsets from −½ to ½. Linear interpolation between them errs by (1/64)²/8 of the
/// curvature, which is at most 3 per cell (rect): 1e-4 cells.
const OFFSETS: usize = 64;

impl Interpolator {
    /// Prepares for peaks under a window with these weights.
    pub(crate) fn new(taper: &[f64]) -> Self {
        let ratio = |step: usize| {
            let offset = offset_of(step as f64);
            let [before, here, after] = [1.0, 0.0, -1.0].map(|cell| transform(taper, offset + cell));
            ratio([[before, here, after]].into_iter())
        };
        Self { ratios: (0..=OFFSETS).map(ratio).collect() }
    }

    /// Offset of the peak from its cell in cells, −0.5…0.5, from the values of all channels.
    pub(crate) fn offset(&self, channels: impl Iterator<Item = Trio>) -> f64 {
        let found = ratio(channels);
        let above = self.ratios.partition_point(|ratio| *ratio < found).clamp(1, OFFSETS);
        let (low, high) = (self.ratios[above - 1], self.ratios[above]);
        let part = if high > low { (found - low) / (high - low) } else { 0.5 };
        offset_of(((above - 1) as f64 + part).clamp(0.0, OFFSETS as f64))
    }
}

fn offset_of(step: f64) -> f64 {
    step / OFFSETS as f64 - 0.5
}

/// Ratio q of three cells, with channels weighted by power, so that a channel's noise counts once.
fn ratio(channels: impl Iterator<Item = Trio>) -> f64 {
    let (mut slope, mut power) = (0.0, 0.0);
    for [before, here, after] in channels {
        slope += ((before - after) * here.conj()).re;
        power += here.norm_sqr();
    }
    // A map of zeros has no peak between its cells.
    if power > 0.0 { slope / power } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::window::taper;
    use artifact::settings::Window;

    const ALL: [Window; 5] =
        [Window::Rect, Window::Hann, Window::Hamming, Window::Blackman, Window::Chebyshev(80.0)];

    #[test]
    fn offsets_of_pure_tones_are_read_to_a_thousandth_of_a_cell() {
        for window in ALL {
            for length in [16, 129, 256] {
                let weights = taper(window, length).unwrap();
                let interpolator = Interpolator::new(&weights);
                for step in -50..=50 {
                    let offset = f64::from(step) / 100.0;
                    let tone = [1.0, 0.0, -1.0].map(|cell| transform(&weights, offset + cell));
                    // Two channels that receive it with arbitrary phases.
                    let channels =
                        [0.3, 2.0].map(|phase| tone.map(|v| v * Complex64::from_polar(1.0, phase)));
                    let error = interpolator.offset(channels.into_iter()) - offset;
                    assert!(error.abs() < 1e-3, "{window:?} of {length} at {offset}: {error}");
                }
            }
        }
    }

    #[test]
    fn ratios_of_rect_and_hann_are_their_closed_forms() {
        let length = 4096;
        for (window, closed) in [
            (Window::Rect, (|d| 2.0 * d / (1.0 - d * d)) as fn(f64) -> f64),
            (Window::Hann, |d| 6.0 * d / (4.0 - d * d)),
        ] {
            let interpolator = Interpolator::new(&taper(window, length).unwrap());
            for (step, ratio) in interpolator.ratios.iter().enumerate() {
                // The closed forms hold for long windows: sin x ≈ x for one sample, (π/N)².
                let error = ratio - closed(offset_of(step as f64));
                assert!(error.abs() < 10.0 / (length * length) as f64, "{window:?}: {error:e}");
            }
        }
    }

    #[test]
    fn a_lonely_cell_or_none_stays_in_its_middle() {
        let interpolator = Interpolator::new(&taper(Window::Hann, 64).unwrap());
        let one = Complex64::ONE;
        assert_eq!(interpolator.offset([[Complex64::ZERO, one, Complex64::ZERO]].into_iter()), 0.0);
        assert_eq!(interpolator.offset([[Complex64::ZERO; 3]].into_iter()), 0.0);
        assert_eq!(interpolator.offset(std::iter::empty()), 0.0);
    }
}
