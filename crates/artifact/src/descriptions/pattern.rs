//! Gain of an antenna element over direction, shared by all stages.

use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_PI_2;

/// Gain of an element over direction, relative to [`crate::descriptions::radar::Link::antenna_gain_db`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Pattern {
    /// Equal gain in every direction.
    Isotropic,
    /// Amplitude cosⁿ of the angle off boresight, zero behind.
    Cosine {
        /// Exponent n.
        exponent: f64,
    },
    /// Measured table; the gain is zero outside it.
    Table(PatternTable),
}

/// Gain measured over azimuth (from the boresight to the right as seen along it) and elevation (above the
/// plane of boresight and right). An axis has either one value, valid for every angle, or at least three in
/// increasing order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PatternTable {
    /// Azimuths of the table, −π … π.
    pub azimuth_rad: Vec<f64>,
    /// Elevations of the table, −π/2 … π/2.
    pub elevation_rad: Vec<f64>,
    /// Amplitude, row-major `[elevation, azimuth]`.
    pub amplitude: Vec<f64>,
}

impl Pattern {
    /// Amplitude towards a unit direction, given as [right, along the boresight, up] of the array.
    pub fn amplitude(&self, [right, ahead, up]: [f64; 3]) -> f64 {
        match self {
            Self::Isotropic => 1.0,
            Self::Cosine { exponent } => {
                if ahead > 0.0 {
                    ahead.powf(*exponent)
                } else {
                    0.0
                }
            }
            Self::Table(table) => table.amplitude_at(right.atan2(ahead), up.clamp(-1.0, 1.0).asin()),
        }
    }
}

impl Pattern {
    /// Whether the gain can be non-zero at right angles to the boresight or behind.
    pub fn radiates_behind(&self) -> bool {
        match self {
            Self::Isotropic => true,
            Self::Cosine { .. } => false,
            Self::Table(table) => match table.azimuth_rad[..] {
                [first, .., last] => first < -FRAC_PI_2 || last > FRAC_PI_2,
                _ => true,
            },
        }
    }
}

impl PatternTable {
    /// Amplitude by cubic interpolation along both axes, with continuous slope; zero outside the table. For
    /// steps h the error per axis is at most h³·max|f‴|/(36√3) + O(h⁴): the slopes are those of parabolas,
    /// wrong by h²f‴/6, and enter a value with h·t(1−t)(1−2t) ≤ h/(6√3).
    pub fn amplitude_at(&self, azimuth_rad: f64, elevation_rad: f64) -> f64 {
        let (Some(columns), Some(rows)) =
            (Stencil::of(&self.azimuth_rad, azimuth_rad), Stencil::of(&self.elevation_rad, elevation_rad))
        else {
            return 0.0;
        };
        let row = |row: usize| columns.sum(|column| self.amplitude[row * self.azimuth_rad.len() + column]);
        rows.sum(row)
    }
}

/// Weights of neighbouring values of an axis in an interpolated value.
struct Stencil {
    first: usize,
    shares: [f64; 4],
}

impl Stencil {
    /// Cubic Hermite interpolation between two values, with the slopes of the parabolas through each value
    /// and its neighbours.
    fn of(axis: &[f64], at: f64) -> Option<Self> {
        let last = axis.len() - 1;
        if last == 0 {
            return Some(Self { first: 0, shares: [1.0, 0.0, 0.0, 0.0] });
        }
        if !(axis[0]..=axis[last]).contains(&at) {
            return None;
        }
        let below = axis.partition_point(|value| *value <= at).clamp(1, last) - 1;
        let mut stencil = Self { first: below.saturating_sub(1), shares: [0.0; 4] };
        let step = axis[below + 1] - axis[below];
        let t = (at - axis[below]) / step;
        let rest = 1.0 - t;
        stencil.shares[below - stencil.first] += rest * rest * (1.0 + 2.0 * t);
        stencil.shares[below + 1 - stencil.first] += t * t * (3.0 - 2.0 * t);
        stencil.add_slope(axis, below, step * t * rest * rest);
        stencil.add_slope(axis, below + 1, -step * t * t * rest);
        Some(stencil)
    }

    /// Adds `factor` times the slope at `place` of the parabola through that value and its neighbours.
    fn add_slope(&mut self, axis: &[f64], place: usize, factor: f64) {
        let middle = place.clamp(1, axis.len() - 2);
        let [p, q, r] = [middle - 1, middle, middle + 1];
        for [own, a, b] in [[p, q, r], [q, p, r], [r, p, q]] {
            let (x, own_x) = (axis[place], axis[own]);
            let slope = (2.0 * x - axis[a] - axis[b]) / ((own_x - axis[a]) * (own_x - axis[b]));
            self.shares[own - self.first] += factor * slope;
        }
    }

    fn sum(&self, value: impl Fn(usize) -> f64) -> f64 {
        let used = self.shares.iter().enumerate().filter(|(_, share)| **share != 0.0);
        used.map(|(i, share)| share * value(self.first + i)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Table of the amplitude cosⁿ of the angle off boresight, which is cosⁿ(az)·cosⁿ(el).
    fn cosine(exponent: f64, steps: usize) -> Pattern {
        let half = 0.5 * PI;
        let angles: Vec<f64> = (0..=steps).map(|i| half * (2.0 * i as f64 / steps as f64 - 1.0)).collect();
        let of = |angle: f64| angle.cos().max(0.0).powf(exponent);
        let amplitude = angles.iter().flat_map(|el| angles.iter().map(move |az| of(*az) * of(*el))).collect();
        Pattern::Table(PatternTable { azimuth_rad: angles.clone(), elevation_rad: angles, amplitude })
    }

    fn direction(azimuth_rad: f64, elevation_rad: f64) -> [f64; 3] {
        let across = elevation_rad.cos();
        [across * azimuth_rad.sin(), across * azimuth_rad.cos(), elevation_rad.sin()]
    }

    #[test]
    fn a_table_of_the_cosine_gives_the_cosine_to_the_stated_error() {
        for (exponent, steps) in [(2.0, 36), (2.0, 180), (4.0, 36), (4.0, 180)] {
            let h = PI / steps as f64;
            // Third and fourth derivatives of cos² = (1 + cos 2θ)/2: 4 and 8; of cos⁴ = (3 + 4cos 2θ + cos
            // 4θ)/8: at most 12 and 40. Of the fourth, h⁴/384 of the cubic itself and h⁴/48 of the slopes'
            // difference: below h⁴/40 together.
            let (third, fourth) = if exponent == 2.0 { (4.0, 8.0) } else { (12.0, 40.0) };
            let of_an_axis = h.powi(3) * third / (36.0 * 3.0_f64.sqrt()) + h.powi(4) * fourth / 40.0;
            let table = cosine(exponent, steps);
            let mut worst: f64 = 0.0;
            for i in 0..997 {
                let share = |step: f64| 0.999 * ((f64::from(i) * step).fract() - 0.5) * PI;
                let to = direction(share(0.618_034), share(0.414_214));
                worst = worst.max((table.amplitude(to) - Pattern::Cosine { exponent }.amplitude(to)).abs());
            }
            // Along the other axis the weights' magnitudes add up to 1.25 at most.
            let bound = 2.25 * of_an_axis;
            println!("cos^{exponent}, {steps} steps: {worst:.2e}, bound {bound:.2e}");
            assert!(worst <= bound, "{worst:e} beyond {bound:e}");
        }
    }

    #[test]
    fn nothing_lies_behind_a_table_of_the_front_and_a_cubic_needs_no_even_steps() {
        let table = cosine(2.0, 36);
        assert_eq!(table.amplitude(direction(0.6 * PI, 0.0)), 0.0);
        assert_eq!(table.amplitude([0.0, -1.0, 0.0]), 0.0);
        // The cubic reproduces parabolas for any steps, up to the ends; a single value holds for every
        // elevation.
        let azimuth_rad = vec![-1.0, -0.7, 0.1, 0.2, 0.9];
        let parabola = |x: f64| 2.0 - 0.3 * x - 0.8 * x * x;
        let amplitude = azimuth_rad.iter().map(|x| parabola(*x)).collect();
        let cut = Pattern::Table(PatternTable { azimuth_rad, elevation_rad: vec![0.0], amplitude });
        for az in [-1.0, -0.93, -0.2, 0.1, 0.15, 0.5, 0.9 - 1e-12] {
            assert!((cut.amplitude(direction(az, 0.3)) - parabola(az)).abs() < 1e-13, "{az}");
        }
    }
}
