//! Effect of windows on the noise of a region of cells: its eigenvalue spectrum, and the share of the cell
//! under test in it.
//!
//! White samples under a taper w give map cells that correlate as ρ = Σw²e^{−j2πnd/N}/Σw² per axis, d cells
//! apart, and as the product of both axes. All regions of the detectors are rectangles, with or without a
//! rectangular hole, so every sum over pairs and triples of cells is composed of products of sums along the
//! axes.
//!
//! With Doppler division a cell sums a band of every transmitter, which are rows of one spectrum
//! (`summed_bands.rs`): bands of different cells may overlap, and those of one cell where they are narrow.
//!
//! For real samples the cell at (−m, −k) of the whole spectrum is the conjugate of that at (m, k). A region's
//! noise then is half of what it and its image contain together, as 2N real variables instead of N complex
//! ones, and the cells of both correlate by their distance like any others: near range 0 and half the sample
//! rate, on the rows around zero and the highest velocity, where a region overlaps its image. (Column 0 of a
//! rectangular window has each of its powers twice, 2N variables of which N are 0.)

use crate::detection::cell_power::CellPower;
use crate::detection::summed_bands::SummedBands;
use crate::error::DspError;
use crate::numerics::saddle_point_inversion::{WeightedGamma, weighted_by};
use crate::numerics::symmetric_qr::eigenvalues;
use crate::spectrum::division::Division;
use crate::spectrum::window::taper;
use artifact::cube::CubeHeader;

/// A rectangle of cells around the cell under test: first and last offset, [doppler, range].
pub(crate) type Rectangle = [[i64; 2]; 2];

/// A rectangle, with or without a rectangular hole.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Region {
    /// The whole rectangle, including the hole.
    pub(crate) whole: Rectangle,
    /// The excluded rectangle.
    pub(crate) hole: Option<Rectangle>,
    /// Offset of the image of the cell under test, [doppler, range], if the region's noise overlaps that of
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

    /// Rectangles of the region and its image, with their signs.
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
    /// Correlation ρ without the phase that cancels in closed chains of cells (windows are symmetric about
    /// N/2), over the bands that cells sum: one in range.
    bands: [SummedBands; 2],
}

/// Correlation below which cells count as independent: a region of 10⁴ cells changes by less than 1e-8.
const NEGLIGIBLE: f64 = 1e-6;
/// Distance beyond a region and its image from which noise is independent: twice the main lobe of a window of
/// −100 dB.
pub(crate) const FAR_CELLS: usize = 8;
/// Maximum number of bands of a region's rows whose eigenvalues are computed: more take seconds.
const MOST_BANDS: usize = 300;
/// Share of power in common with its image from which a region overlaps it: with α = 15, N = 100 the rate
/// changes by α²/2N of it.
const MEETS: f64 = 1e-4;

impl Correlation {
    /// Computes the correlation under a header's windows, far enough for regions of these half sizes and the
    /// images that they overlap.
    pub(crate) fn new(header: &CubeHeader, outer: [usize; 2]) -> Result<Self, DspError> {
        let waveform = &header.radar.waveform;
        let doppler = taper(header.dsp.doppler_window, waveform.chirps as usize)?;
        let range = taper(header.dsp.range_window, waveform.samples as usize)?;
        let division = Division::of(&header.radar);
        let lags = |axis: usize| 4 * outer[axis] + FAR_CELLS;
        let bands = [SummedBands::of(&division, &doppler, lags(0)), SummedBands::alone(&range, lags(1))];
        Ok(Self { bands })
    }

    /// Whether all cells are uncorrelated.
    pub(crate) fn is_white(&self) -> bool {
        self.bands.iter().all(SummedBands::are_white)
    }

    /// Power of the cell under test, over M channels.
    pub(crate) fn cell_power(&self, channels: usize) -> CellPower {
        CellPower::of(&self.bands[0].cell_eigenvalues(), channels)
    }

    /// Whether a region's noise correlates with that of its image.
    pub(crate) fn meets_image(&self, region: &Region) -> bool {
        let alone = Region { image: None, ..region.clone() };
        self.among(region, 1) - self.among(&alone, 1) > MEETS * region.cells() as f64
    }

    /// Share c of the cell under test in the mean of a region: Σκ_0i/N.
    pub(crate) fn leak(&self, region: &Region) -> f64 {
        (self.pairs(region, &CENTRE, 1) / region.cells() as f64).max(0.0)
    }

    /// Sum Σκ_ij^n over pairs of different cells of a region, and over cells and images.
    pub(crate) fn among(&self, region: &Region, exponent: i32) -> f64 {
        let pairs: f64 = region.parts().map(|(sign, part)| sign * self.pairs(region, &part, exponent)).sum();
        (pairs - region.cells() as f64).max(0.0)
    }

    /// Mean power of a region's noise as a sum of Gamma variables: two groups of equal eigenvalues.
    ///
    /// The power of N correlated cells is Σλ_i·E_i over the eigenvalues of their correlation matrix.
    /// Probabilities depend only on Σ ln(1 + sλ_i); Gauss's rule of two nodes over the eigenvalues preserves
    /// their number and their first three powers: N, Σρ_ii = N, Σκ_ij and Σρ_ij·ρ_jk·ρ_ki. For cells that sum
    /// bands one group preserves two of them: triples of bands are many, and such sums nearly normal.
    pub(crate) fn mean_power(&self, region: &Region, channels: usize) -> Vec<WeightedGamma> {
        let count = region.cells() as f64;
        let group = |eigenvalue: f64, share: f64| WeightedGamma {
            weight: eigenvalue / (count * channels as f64),
            shape: share * count * channels as f64,
        };
        let spread = self.among(region, 1) / count;
        if self.bands[0].count() > 1 {
            let eigenvalue = self.bands[0].with_itself() * (1.0 + spread);
            return vec![group(eigenvalue, 1.0 / eigenvalue)];
        }
        if spread < NEGLIGIBLE {
            return vec![group(1.0, 1.0)];
        }
        let third = self.triples(region) / count - 3.0 * spread - 1.0;
        let skew = 0.5 * third / spread;
        let root = (skew * skew + spread).sqrt();
        // Eigenvalues are non-negative; rounding must not change that.
        let (above, below) = (skew + root, (skew - root).max(-1.0 + NEGLIGIBLE));
        let share = -below / (above - below);
        vec![group(1.0 + above, share), group(1.0 + below, 1.0 - share)]
    }

    /// Mean power of a rectangle's noise: like [`Self::mean_power`], with Gauss's rule of eight nodes.
    ///
    /// The smaller of two means depends on the lower tail of a thin half, where the small eigenvalues decide;
    /// with so many bands that this becomes slow, no half is thin.
    pub(crate) fn rectangle_power(&self, region: &Region, channels: usize) -> Vec<WeightedGamma> {
        let [rows, _] = region.whole.map(|[first, last]| (last - first + 1) as usize);
        if self.bands[0].count() > 1 && rows * self.bands[0].count() > MOST_BANDS {
            return self.mean_power(region, channels);
        }
        let eigenvalues = match region.image {
            None => self.of_rectangle(&region.whole),
            Some(image) => self.of_rectangle_and_image(&region.whole, image),
        };
        let all = region.cells() as f64 * channels as f64;
        weighted_by(&eigenvalues, 8, all, all)
    }

    /// Eigenvalues of a rectangle, the products of those of its two sides.
    fn of_rectangle(&self, rectangle: &Rectangle) -> Vec<f64> {
        let side = |axis: usize| {
            let length = (rectangle[axis][1] - rectangle[axis][0] + 1) as usize;
            eigenvalues(self.bands[axis].matrix(length))
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

    /// Correlation of cells of one band.
    fn rho(&self, axis: usize, lag: i64) -> f64 {
        self.bands[axis].rho(lag, 0)
    }

    /// Sum Σκ^n between the cells of a region, including its image's, and those of a rectangle; κ of a cell
    /// with itself is 1.
    fn pairs(&self, region: &Region, with: &Rectangle, exponent: i32) -> f64 {
        let kappa = self.bands.each_ref().map(|bands| {
            let with_itself = bands.with_itself();
            bands.power().iter().map(|k| (k / with_itself).powi(exponent)).collect::<Vec<f64>>()
        });
        let sum = |axis: usize, a: [i64; 2], b: [i64; 2]| -> f64 {
            let longest = kappa[axis].len() as i64;
            let pairs = |lag: i64| (a[1].min(b[1] + lag) - a[0].max(b[0] + lag) + 1).max(0) as f64;
            (1 - longest..longest).map(|lag| at_lag(&kappa[axis], lag) * pairs(lag)).sum()
        };
        region.all_parts().map(|(sign, a)| sign * sum(0, a[0], with[0]) * sum(1, a[1], with[1])).sum()
    }

    fn triples(&self, region: &Region) -> f64 {
        let mut total = 0.0;
        for (sign_a, a) in region.parts() {
            for (sign_b, b) in region.all_parts() {
                for (sign_c, c) in region.all_parts() {
                    let along =
                        |axis: usize| triple_sum(self.bands[axis].within(), [a[axis], b[axis], c[axis]]);
                    total += sign_a * sign_b * sign_c * along(0) * along(1);
                }
            }
        }
        total
    }
}

/// Eigenvalue below which only rounding remains of 0.
const NO_POWER: f64 = 1e-12;

fn at_lag(of_lag: &[f64], lag: i64) -> f64 {
    of_lag.get(lag.unsigned_abs() as usize).copied().unwrap_or(0.0)
}

const CENTRE: Rectangle = [[0, 0], [0, 0]];

/// Sum Σρ(i − j)·ρ(j − k)·ρ(k − i) over three intervals, without the lags at which ρ is negligible: these may
/// lie between others, since the response of a window repeats after the length of its axis.
fn triple_sum(rho: &[f64], [a, b, c]: [[i64; 2]; 3]) -> f64 {
    let longest = rho.len() as i64;
    let lags: Vec<i64> = (1 - longest..longest).filter(|lag| at_lag(rho, *lag) != 0.0).collect();
    let near = |at: i64, [first, last]: [i64; 2]| {
        lags.iter().map(move |lag| at + lag).filter(move |near| (first..=last).contains(near))
    };
    let at = |i: i64, j: i64| at_lag(rho, i - j);
    let closed = |i: i64, j: i64| -> f64 { near(i, c).map(|k| at(j, k) * at(k, i)).sum() };
    (a[0]..=a[1]).map(|i| near(i, b).map(|j| at(i, j) * closed(i, j)).sum::<f64>()).sum()
}
