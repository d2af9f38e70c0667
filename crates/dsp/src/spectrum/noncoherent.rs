//! Noncoherent sum over channels, and the noise level of a map.

use crate::error::DspError;
use crate::spectrum::shapes::Shapes;
use artifact::cube::CubeHeader;
use artifact::rdm::RdmFrame;
use artifact::units::power;
use ndarray::{Array2, ArrayView2};
use num_complex::Complex32;
use rayon::prelude::*;

/// Level of the floor assumed for noise in a noise-free map, below its peak, dB.
pub(crate) const FLOOR_BELOW_PEAK_DB: f64 = 60.0;

/// Noncoherent sum Σ |value|² over channels, `[doppler, range]`.
pub fn power_map(header: &CubeHeader, map: &RdmFrame) -> Result<Array2<f64>, DspError> {
    PowerLevels::of(&Shapes::of(header)?, map).map(|levels| levels.power)
}

/// Mean noise power of one cell of one channel: the assumed floor of a noise-free map, else from the map's
/// median.
pub fn noise_power(header: &CubeHeader, map: &RdmFrame) -> Result<f64, DspError> {
    PowerLevels::of(&Shapes::of(header)?, map).map(|levels| levels.noise())
}

/// Powers of a checked map.
pub(crate) struct PowerLevels {
    power: Array2<f64>,
    channels: f64,
    assumed_floor: Option<f64>,
}

impl PowerLevels {
    /// Sums the powers of a map.
    ///
    /// # Errors
    /// The map has another shape, or contains non-finite values.
    pub(crate) fn of(shapes: &Shapes, map: &RdmFrame) -> Result<Self, DspError> {
        shapes.check_map(map)?;
        let [channels, rows, columns] = shapes.map;
        let sums = sum_over_channels(&map.values, rows * columns);
        let power = Array2::from_shape_vec((rows, columns), sums).unwrap_or_default();
        Ok(Self { power, channels: channels as f64, assumed_floor: map.assumed_floor })
    }

    /// Noncoherent sum Σ |value|² over channels, `[doppler, range]`.
    pub(crate) fn power(&self) -> ArrayView2<'_, f64> {
        self.power.view()
    }

    /// Mean over channels, `[doppler, range]`.
    pub(crate) fn into_mean(self) -> Array2<f64> {
        self.power / self.channels
    }

    /// Mean noise power of one cell of one channel: the assumed floor of a noise-free map, else from the
    /// map's median.
    ///
    /// The median is insensitive to targets that fill few cells (1 % of the cells: 0.06 dB for one channel).
    pub(crate) fn noise(&self) -> f64 {
        if let Some(floor) = self.assumed_floor {
            return floor / self.channels;
        }
        let mut power: Vec<f64> = self.power.iter().copied().collect();
        let middle = power.len() / 2;
        let (_, median, _) = power.select_nth_unstable_by(middle, f64::total_cmp);
        *median / gamma_median(self.channels)
    }
}

/// Number of cells summed by one thread, over all channels in order.
const CELLS_PER_RUN: usize = 4096;

pub(crate) fn sum_over_channels(values: &[Complex32], cells: usize) -> Vec<f64> {
    let mut sum = vec![0.0; cells];
    sum.par_chunks_mut(CELLS_PER_RUN).enumerate().for_each(|(run, sum)| {
        for channel in values.chunks_exact(cells) {
            for (total, value) in sum.iter_mut().zip(&channel[run * CELLS_PER_RUN..]) {
                *total += power(*value);
            }
        }
    });
    sum
}

/// Median of a sum of M unit exponentials: exact for one, else Choi (Proc. AMS 121 (1994) 245), M − 1/3 +
/// 8/405M.
fn gamma_median(channels: f64) -> f64 {
    if channels == 1.0 { std::f64::consts::LN_2 } else { channels - 1.0 / 3.0 + 8.0 / (405.0 * channels) }
}
