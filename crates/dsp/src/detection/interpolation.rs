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
    of_both: RatioCurve,
    /// Ratios without the cell before.
    of_after: RatioCurve,
}

/// Values of one channel in the cell before a peak, at the peak, and after it.
pub(crate) type Trio = [Complex64; 3];

/// Neighbours of a peak that hold the same tone as it does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sides {
    /// The cells before and after it.
    Both,
    /// The cell before it alone.
    Before,
    /// The cell after it alone.
    After,
}

/// Number of tabulated offsets per cell. Linear interpolation between them errs by (1/64)²/8 of the
/// curvature, which is at most 3 per cell (rect): 1e-4 cells.
const OFFSETS: usize = 64;
/// Largest offset towards a side without a cell: a tone beyond the end of an axis that is no circle remains
/// strongest in the last cell.
const BEYOND: f64 = 0.75;

impl Interpolator {
    /// Prepares for peaks under a window with these weights.
    pub(crate) fn new(taper: &[f64]) -> Self {
        let trio = |offset: f64| [1.0, 0.0, -1.0].map(|cell| transform(taper, offset + cell));
        let curve = |sides: Sides, least: f64| {
            let ratio = |offset: f64| ratio([sided(sides, trio(offset))].into_iter()).unwrap_or(0.0);
            let steps = ((0.5 - least) * OFFSETS as f64) as usize;
            let ratios = (0..=steps).map(|step| ratio(least + step as f64 / OFFSETS as f64)).collect();
            RatioCurve { least, ratios }
        };
        Self { of_both: curve(Sides::Both, -0.5), of_after: curve(Sides::After, -BEYOND) }
    }

    /// Offset of the peak from its cell in cells, −0.5…0.5, from the values of all channels; to 0.75 towards
    /// a side that has no cell.
    pub(crate) fn offset(&self, sides: Sides, channels: impl Iterator<Item = Trio>) -> f64 {
        // A map of zeros has no peak between its cells.
        let Some(found) = ratio(channels.map(|trio| sided(sides, trio))) else { return 0.0 };
        match sides {
            Sides::Both => self.of_both.offset(found),
            Sides::After => self.of_after.offset(found),
            // A window's transform at −δ is the conjugate of that at δ.
            Sides::Before => -self.of_after.offset(-found),
        }
    }
}

/// Ratios of a tone by its offset, in steps from the least.
struct RatioCurve {
    least: f64,
    ratios: Vec<f64>,
}

impl RatioCurve {
    fn offset(&self, found: f64) -> f64 {
        let last = self.ratios.len() - 1;
        let above = self.ratios.partition_point(|ratio| *ratio < found).clamp(1, last);
        let (low, high) = (self.ratios[above - 1], self.ratios[above]);
        let part = if high > low { (found - low) / (high - low) } else { 0.5 };
        self.least + ((above - 1) as f64 + part).clamp(0.0, last as f64) / OFFSETS as f64
    }
}

/// A trio without the cell that does not count.
fn sided(sides: Sides, [before, here, after]: Trio) -> Trio {
    match sides {
        Sides::Both => [before, here, after],
        Sides::Before => [before, here, Complex64::ZERO],
        Sides::After => [Complex64::ZERO, here, after],
    }
}

/// Ratio q of three cells, with channels weighted by power, so that a channel's noise counts once; `None`
/// without power.
fn ratio(channels: impl Iterator<Item = Trio>) -> Option<f64> {
    let (mut slope, mut power) = (0.0, 0.0);
    for [before, here, after] in channels {
        slope += ((before - after) * here.conj()).re;
        power += here.norm_sqr();
    }
    (power > 0.0).then(|| slope / power)
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
                for (sides, steps) in
                    [(Sides::Both, -50..=50), (Sides::After, -75..=50), (Sides::Before, -50..=75)]
                {
                    for offset in steps.map(|step| f64::from(step) / 100.0) {
                        let tone = [1.0, 0.0, -1.0].map(|cell| transform(&weights, offset + cell));
                        // Two channels that receive it with arbitrary phases.
                        let channels =
                            [0.3, 2.0].map(|phase| tone.map(|v| v * Complex64::from_polar(1.0, phase)));
                        let error = interpolator.offset(sides, channels.into_iter()) - offset;
                        assert!(error.abs() < 1e-3, "{window:?} of {length} at {offset}, {sides:?}: {error}");
                    }
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
            for (step, ratio) in interpolator.of_both.ratios.iter().enumerate() {
                // The closed forms hold for long windows: sin x ≈ x for one sample, (π/N)².
                let error = ratio - closed(step as f64 / OFFSETS as f64 - 0.5);
                assert!(error.abs() < 10.0 / (length * length) as f64, "{window:?}: {error:e}");
            }
        }
    }

    #[test]
    fn a_lonely_cell_or_none_stays_in_its_middle() {
        let interpolator = Interpolator::new(&taper(Window::Hann, 64).unwrap());
        let one = Complex64::ONE;
        assert_eq!(
            interpolator.offset(Sides::Both, [[Complex64::ZERO, one, Complex64::ZERO]].into_iter()),
            0.0
        );
        assert_eq!(interpolator.offset(Sides::Both, [[Complex64::ZERO; 3]].into_iter()), 0.0);
        assert_eq!(interpolator.offset(Sides::Both, std::iter::empty()), 0.0);
    }
}
