//! Effect of windows on the noise of a region of cells: its spectrum of powers, and its share of the cell
//! under test.
//!
//! White samples under a taper w make map cells that correlate as ρ = Σw²e^{−j2πnd/N}/Σw² per axis, d cells
//! apart, and as the product of both axes. All regions of the detectors are rectangles, or one without
//! another, so every sum over pairs and triples of cells is made of products of sums along the axes.
//!
//! Of real samples the cell at (−m, −k) of the whole spectrum is the conjugate of that at (m, k). A region's
//! noise then is half of what it and its image hold together, as 2N real variables instead of N complex ones,
//! and the cells of both correlate by their distance as any others do: near range 0 and half the sample rate,
//! on the rows about zero velocity and about the fastest, where a region meets its image. (Column 0 of a
//! rectangular window has each of its powers twice, 2N variables of which N are 0.)

use crate::error::DspError;
use crate::numerics::gauss_quadrature::gauss_nodes;
use crate::numerics::saddle_point_inversion::WeightedGamma;
use crate::numerics::symmetric_qr::eigenvalues;
use crate::spectrum::division::Division;
use crate::spectrum::doppler_bands::band_cycles;
use crate::spectrum::window::{noise_correlation, taper};
use artifact::cube::CubeHeader;
use artifact::radar::Multiplexing;
use std::f64::consts::TAU;

/// A rectangle of cells around the cell under test: first and last offset, [doppler, range].
pub(crate) type Rectangle = [[i64; 2]; 2];

/// A rectangle, or one without another inside it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Region {
    /// The rectangle in whole, with the hole.
    pub(crate) whole: Rectangle,
    /// The rectangle that is left out.
    pub(crate) hole: Option<Rectangle>,
    /// Offset of the image of the cell under test, [doppler, range], where the region's noise meets that of
    /// its image.
    pub(crate) image: Option<[i64; 2]>,
}

impl Region {
    /// Number of cells.
    pub(crate) fn cells(&self) -> usize {
        cells(&self.whole) - self.hole.as_ref().map_or(0, cells)
    }

    fn parts(&self) -> impl Iterator<Item = (f64, Rectangle)> + Clone + use<> {
        std::iter::once((1.0, self.whole)).chain(self.hole.map(|hole| (-1.0, hole)))
    }

    /// The region's and its image's.
    fn all_parts(&self) -> impl Iterator<Item = (f64, Rectangle)> + Clone + use<> {
        let own = self.parts();
        let images = self.image.into_iter().flat_map(move |image| {
            own.clone()
                .map(move |(sign, part)| (sign, [0, 1].map(|axis: usize| mirrored(part[axis], image[axis]))))
        });
        self.parts().chain(images)
    }
}

fn mirrored([first, last]: [i64; 2], image: i64) -> [i64; 2] {
    [image - last, image - first]
}

fn cells(rectangle: &Rectangle) -> usize {
    rectangle.iter().map(|[first, last]| (last - first + 1).max(0) as usize).product()
}

/// Correlation of noise cells over their distance, [doppler, range].
pub(crate) struct Correlation {
    /// Correlation ρ less the phase that no closed chain of cells keeps (windows are symmetric about N/2).
    amplitude: [Vec<f64>; 2],
    /// |ρ|².
    power: [Vec<f64>; 2],
}

/// Correlations below this are none: a region of 10⁴ cells gains less than 1e-8 by them.
const NEGLIGIBLE: f64 = 1e-6;
/// Noise farther apart than this beyond a region and its image is independent: twice the main lobe of a
/// window of −100 dB.
pub(crate) const FAR_CELLS: usize = 8;
/// A region that shares less than this part of its power with its image does not meet it: with α = 15, N =
/// 100 the rate changes by α²/2N of it.
const MEETS: f64 = 1e-4;

impl Correlation {
    /// Finds the correlation under a header's windows, far enough for regions of these half sizes and images
    /// that they meet.
    pub(crate) fn new(header: &CubeHeader, outer: [usize; 2]) -> Result<Self, DspError> {
        let waveform = &header.radar.waveform;
        let doppler = taper(header.dsp.doppler_window, waveform.chirps as usize)?;
        let range = taper(header.dsp.range_window, waveform.samples as usize)?;
        let division = Division::of(&header.radar);
        let lags = |axis: usize| (0..=4 * outer[axis] + FAR_CELLS).map(|lag| lag as f64);
        let power = [
            lags(0).map(|lag| doppler_correlation(&division, &doppler, lag)).collect::<Vec<f64>>(),
            lags(1).map(|lag| noise_correlation(&range, lag)).collect(),
        ];
        let signed = |power: &[f64], taper: &[f64]| -> Vec<f64> {
            let sign = |lag: usize| amplitude_sign(taper, lag as f64);
            power
                .iter()
                .enumerate()
                .map(|(lag, k)| negligible_is_none(k.max(0.0).sqrt() * sign(lag)))
                .collect()
        };
        let amplitude = [signed(&power[0], &doppler), signed(&power[1], &range)];
        Ok(Self { amplitude, power })
    }

    /// Whether no cell correlates with another.
    pub(crate) fn is_white(&self) -> bool {
        self.amplitude.iter().flat_map(|axis| &axis[1..]).all(|rho| *rho == 0.0)
    }

    /// Whether a region's noise has something in common with that of its image.
    pub(crate) fn meets_image(&self, region: &Region) -> bool {
        let alone = Region { image: None, ..region.clone() };
        self.among(region, 1) - self.among(&alone, 1) > MEETS * region.cells() as f64
    }

    /// Share c of the cell under test in the mean of a region: Σκ_0i/N.
    pub(crate) fn leak(&self, region: &Region) -> f64 {
        (self.pairs(region, &CENTRE, 1) / region.cells() as f64).max(0.0)
    }

    /// Σκ_ij^n over pairs of different cells of a region, and of cells and images.
    pub(crate) fn among(&self, region: &Region, exponent: i32) -> f64 {
        let pairs: f64 = region.parts().map(|(sign, part)| sign * self.pairs(region, &part, exponent)).sum();
        (pairs - region.cells() as f64).max(0.0)
    }

    /// The mean power of a region's noise as a sum of Gamma variables: two groups of equal eigenvalues.
    ///
    /// The power of N correlated cells is Σλ_i·E_i over the eigenvalues of their correlation matrix. All that
    /// enters a probability is Σ ln(1 + sλ_i); Gauss's rule of two nodes over the eigenvalues keeps their
    /// number and their first three powers: N, Σρ_ii = N, Σκ_ij and Σρ_ij·ρ_jk·ρ_ki.
    pub(crate) fn mean_power(&self, region: &Region, channels: usize) -> Vec<WeightedGamma> {
        let count = region.cells() as f64;
        let group = |eigenvalue: f64, share: f64| WeightedGamma {
            weight: eigenvalue / (count * channels as f64),
            shape: share * count * channels as f64,
        };
        let spread = self.among(region, 1) / count;
        if spread < NEGLIGIBLE {
            return vec![group(1.0, 1.0)];
        }
        let third = self.triples(region) / count - 3.0 * spread - 1.0;
        let skew = 0.5 * third / spread;
        let root = (skew * skew + spread).sqrt();
        // Eigenvalues are not negative; rounding must not make them so.
        let (above, below) = (skew + root, (skew - root).max(-1.0 + NEGLIGIBLE));
        let share = -below / (above - below);
        vec![group(1.0 + above, share), group(1.0 + below, 1.0 - share)]
    }

    /// The mean power of a rectangle's noise: as [`Self::mean_power`] with Gauss's rule of eight nodes.
    ///
    /// The smaller of two means lives in the lower tail of a thin half, where the small eigenvalues decide.
    pub(crate) fn rectangle_power(&self, region: &Region, channels: usize) -> Vec<WeightedGamma> {
        let eigenvalues = match region.image {
            None => self.of_rectangle(&region.whole),
            Some(image) => self.of_rectangle_and_image(&region.whole, image),
        };
        let all = region.cells() as f64 * channels as f64;
        let group =
            |(eigenvalue, share): (f64, f64)| WeightedGamma { weight: eigenvalue / all, shape: share * all };
        gauss_nodes(&eigenvalues, 8)
            .into_iter()
            .map(group)
            .filter(|g| g.shape > 1e-9 && g.weight > 0.0)
            .collect()
    }

    /// The products of those of its two sides.
    fn of_rectangle(&self, rectangle: &Rectangle) -> Vec<f64> {
        let side = |axis: usize| {
            let length = (rectangle[axis][1] - rectangle[axis][0] + 1) as usize;
            let row = |i: usize| (0..length).map(|j| self.rho(axis, i as i64 - j as i64)).collect();
            eigenvalues((0..length).map(row).collect())
        };
        let (doppler, range) = (side(0), side(1));
        doppler.iter().flat_map(|a| range.iter().map(move |b| (a * b).max(NO_POWER))).collect()
    }

    /// Eigenvalues of the noise of real parts, whose covariances are the sums of those between cells and
    /// those with images, and of imaginary parts, whose covariances are the differences.
    fn of_rectangle_and_image(&self, [rows, columns]: &Rectangle, image: [i64; 2]) -> Vec<f64> {
        let cells: Vec<[i64; 2]> =
            (rows[0]..=rows[1]).flat_map(|i| (columns[0]..=columns[1]).map(move |j| [i, j])).collect();
        let direct = |a: &[i64; 2], b: &[i64; 2]| self.rho(0, a[0] - b[0]) * self.rho(1, a[1] - b[1]);
        let part = |sign: f64| {
            let entry = |a: &[i64; 2], b: &[i64; 2]| {
                direct(a, b) + sign * direct(a, &[image[0] - b[0], image[1] - b[1]])
            };
            let matrix: Vec<Vec<f64>> =
                cells.iter().map(|a| cells.iter().map(|b| entry(a, b)).collect()).collect();
            eigenvalues(matrix)
        };
        [1.0, -1.0].into_iter().flat_map(part).map(|value| value.max(NO_POWER)).collect()
    }

    fn rho(&self, axis: usize, lag: i64) -> f64 {
        at_lag(&self.amplitude[axis], lag)
    }

    /// Σκ^n between the cells of a region, its image's among them, and those of a rectangle.
    fn pairs(&self, region: &Region, with: &Rectangle, exponent: i32) -> f64 {
        let kappa =
            [0, 1].map(|axis: usize| self.power[axis].iter().map(|k| k.powi(exponent)).collect::<Vec<f64>>());
        let sum = |axis: usize, a: [i64; 2], b: [i64; 2]| -> f64 {
            (a[0]..=a[1]).map(|i| (b[0]..=b[1]).map(|j| at_lag(&kappa[axis], i - j)).sum::<f64>()).sum()
        };
        region.all_parts().map(|(sign, a)| sign * sum(0, a[0], with[0]) * sum(1, a[1], with[1])).sum()
    }

    fn triples(&self, region: &Region) -> f64 {
        let mut total = 0.0;
        for (sign_a, a) in region.parts() {
            for (sign_b, b) in region.all_parts() {
                for (sign_c, c) in region.all_parts() {
                    let along = |axis: usize| triple_sum(&self.amplitude[axis], [a[axis], b[axis], c[axis]]);
                    total += sign_a * sign_b * sign_c * along(0) * along(1);
                }
            }
        }
        total
    }
}

/// Eigenvalues are not negative: what rounding leaves of those that are 0.
const NO_POWER: f64 = 1e-12;

fn at_lag(of_lag: &[f64], lag: i64) -> f64 {
    of_lag.get(lag.unsigned_abs() as usize).copied().unwrap_or(0.0)
}

const CENTRE: Rectangle = [[0, 0], [0, 0]];

fn negligible_is_none(rho: f64) -> f64 {
    if rho.abs() < NEGLIGIBLE { 0.0 } else { rho }
}

/// Sign of Σw²cos(2π·lag·(n − N/2)/N).
fn amplitude_sign(taper: &[f64], lag: f64) -> f64 {
    let length = taper.len() as f64;
    let angle = |n: usize| TAU * lag * (n as f64 / length - 0.5);
    taper.iter().enumerate().map(|(n, w)| w * w * angle(n).cos()).sum::<f64>().signum()
}

/// Σρ(i − j)·ρ(j − k)·ρ(k − i) over three intervals, without the lags at which ρ is none.
fn triple_sum(rho: &[f64], [a, b, c]: [[i64; 2]; 3]) -> f64 {
    let reach = rho.iter().rposition(|r| *r != 0.0).unwrap_or(0) as i64;
    let near = |at: i64, [first, last]: [i64; 2]| first.max(at - reach)..=last.min(at + reach);
    let at = |i: i64, j: i64| at_lag(rho, i - j);
    let closed = |i: i64, j: i64| -> f64 { near(i, c).map(|k| at(j, k) * at(k, i)).sum() };
    (a[0]..=a[1]).map(|i| near(i, b).map(|j| at(i, j) * closed(i, j)).sum::<f64>()).sum()
}

/// Correlation |ρ|² of noise between rows `lag` apart. With Doppler division a summed cell holds bands of one
/// receiver, i/M apart: cells correlate where bands meet.
fn doppler_correlation(division: &Division, taper: &[f64], lag: f64) -> f64 {
    if division.multiplexing != Multiplexing::Ddm {
        return noise_correlation(taper, lag);
    }
    let transmitters = division.transmitters as i64;
    let band_rows = band_cycles(division, 1) * taper.len() as f64;
    let weighted = |shift: i64| {
        let pairs = (transmitters - shift.abs()) as f64 / transmitters as f64;
        pairs * noise_correlation(taper, lag + shift as f64 * band_rows)
    };
    (1 - transmitters..transmitters).map(weighted).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fewer_different_points_than_nodes_are_returned_themselves() {
        let nodes = gauss_nodes(&[1.0; 13], 8);
        assert_eq!(nodes.len(), 1);
        assert!((nodes[0].0 - 1.0).abs() < 1e-14 && (nodes[0].1 - 1.0).abs() < 1e-14);
    }
}
