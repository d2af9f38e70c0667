//! Where between cells a peak lies: a parabola through the log powers of three cells, freed of its bias.
//!
//! The parabola is only nearly right for a window's main lobe (Hann: off by up to 0.016 cells, rect 0.17). What it says of
//! a tone at a known offset is computed once per window and read backwards.

use crate::window::response;

/// Reads offsets from powers for one window and axis.
pub struct Interpolator {
    /// Parabola's answer for a tone at each offset of `0..=STEPS`, in halves of a cell over `STEPS`.
    answers: Vec<f64>,
}

/// Offsets between 0 and half a cell at which the curve is kept: linear reading between them leaves 1e-4 cells.
const STEPS: usize = 32;
/// Weakest neighbour that a logarithm is taken of, over the peak: below it a cell holds rounding or noise.
const WEAKEST: f64 = 1e-12;

impl Interpolator {
    /// For peaks that a window of these weights makes.
    pub fn new(taper: &[f64]) -> Self {
        let answer = |step: usize| {
            let offset = offset_of(step as f64);
            let power = [-1.0, 0.0, 1.0].map(|cell| response(taper, cell - offset));
            parabola(power)
        };
        Self { answers: (0..=STEPS).map(answer).collect() }
    }

    /// Offset of the peak from its cell in cells, −0.5…0.5, from the powers of the cell before, the cell and the next.
    pub fn offset(&self, power: [f64; 3]) -> f64 {
        let found = parabola(power);
        let size = found.abs();
        let above = self.answers.partition_point(|answer| *answer < size).clamp(1, STEPS);
        let (low, high) = (self.answers[above - 1], self.answers[above]);
        let step = if high > low { (above - 1) as f64 + (size - low) / (high - low) } else { above as f64 };
        offset_of(step.clamp(0.0, STEPS as f64)).copysign(found)
    }
}

fn offset_of(step: f64) -> f64 {
    0.5 * step / STEPS as f64
}

fn parabola(power: [f64; 3]) -> f64 {
    let [before, here, after] = power.map(|p| p.max(WEAKEST * power[1]).ln());
    let curvature = before - 2.0 * here + after;
    // Equal powers (a map of nothing) have no peak between them.
    if curvature < 0.0 { (0.5 * (before - after) / curvature).clamp(-0.5, 0.5) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::window::taper;
    use artifact::settings::Window;

    #[test]
    fn offsets_of_pure_tones_are_read_to_a_thousandth_of_a_cell() {
        for window in [Window::Hann, Window::Hamming, Window::Blackman, Window::Chebyshev(80.0)] {
            for length in [16, 129, 256] {
                let weights = taper(window, length).unwrap();
                let interpolator = Interpolator::new(&weights);
                for step in -20..=20 {
                    let offset = 0.5 * f64::from(step) / 20.0;
                    let power = [-1.0, 0.0, 1.0].map(|cell| response(&weights, cell - offset));
                    // Linear reading of a smooth curve of slope near 1 over steps of 1/64 cell: error < (1/64)²/8·curvature.
                    let error = interpolator.offset(power) - offset;
                    assert!(error.abs() < 1e-3, "{window:?} of {length} at {offset}: {error}");
                }
            }
        }
    }

    #[test]
    fn a_flat_or_lonely_cell_stays_in_its_middle() {
        let interpolator = Interpolator::new(&taper(Window::Hann, 64).unwrap());
        assert_eq!(interpolator.offset([1.0, 1.0, 1.0]), 0.0);
        assert_eq!(interpolator.offset([0.0, 1.0, 0.0]), 0.0);
        assert_eq!(interpolator.offset([0.0, 0.0, 0.0]), 0.0);
    }
}
