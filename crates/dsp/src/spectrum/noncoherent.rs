//! Noncoherent sum over channels, and the noise level of a map.

use crate::error::DspError;
use crate::numerics::finite::first_not_finite;
use crate::spectrum::axes::checked_shape;
use artifact::cube::CubeHeader;
use artifact::rdm::RdmFrame;
use ndarray::Array2;
use num_complex::Complex32;
use rayon::prelude::*;

/// What stands in for noise in a noise-free map lies this far below its peak, dB.
pub(crate) const FLOOR_BELOW_PEAK_DB: f64 = 60.0;

/// Σ over channels of |value|², `[doppler, range]`.
pub fn power_map(header: &CubeHeader, map: &RdmFrame) -> Result<Array2<f64>, DspError> {
    let [_, chirps, samples] = checked_map(header, map)?;
    let power = sum_over_channels(&map.values, chirps * samples);
    Array2::from_shape_vec((chirps, samples), power).map_err(|_| DspError::MapSize {
        what: "values",
        expected: chirps * samples,
        found: map.values.len(),
    })
}

/// Mean noise power of one cell of one channel: the assumed floor of a noise-free map, else from the map's
/// median.
///
/// The median does not feel targets as long as they fill few cells (1 % of the cells: 0.06 dB for one
/// channel).
pub fn noise_power(header: &CubeHeader, map: &RdmFrame) -> Result<f64, DspError> {
    let channels = checked_map(header, map)?[0] as f64;
    if let Some(floor) = map.assumed_floor {
        return Ok(floor / channels);
    }
    let power = power_map(header, map)?;
    let mut power = power.into_raw_vec_and_offset().0;
    let middle = power.len() / 2;
    let (_, median, _) = power.select_nth_unstable_by(middle, f64::total_cmp);
    Ok(*median / gamma_median(channels))
}

/// Cells that one thread adds up, over all channels in their order.
const RUN: usize = 4096;

pub(crate) fn sum_over_channels(values: &[Complex32], cells: usize) -> Vec<f64> {
    let mut sum = vec![0.0; cells];
    sum.par_chunks_mut(RUN).enumerate().for_each(|(run, sum)| {
        for channel in values.chunks_exact(cells) {
            for (total, value) in sum.iter_mut().zip(&channel[run * RUN..]) {
                *total += f64::from(value.re).powi(2) + f64::from(value.im).powi(2);
            }
        }
    });
    sum
}

/// Shape of a map whose arrays have the length that its header asks for and hold numbers.
pub(crate) fn checked_map(header: &CubeHeader, map: &RdmFrame) -> Result<[usize; 3], DspError> {
    let shape @ [channels, chirps, samples] = checked_shape(header)?;
    let cells = chirps * samples;
    for (what, expected, found) in
        [("values", channels * cells, map.values.len()), ("mask cells", cells, map.mask.len())]
    {
        if expected != found {
            return Err(DspError::MapSize { what, expected, found });
        }
    }
    match first_not_finite(&map.values) {
        None => Ok(shape),
        Some(at) => Err(DspError::ValueNotFinite { channel: at / cells, cell: at % cells }),
    }
}

/// Median of a sum of M unit exponentials: exact for one, else Choi (Proc. AMS 121 (1994) 245), M − 1/3 +
/// 8/405M.
fn gamma_median(channels: f64) -> f64 {
    if channels == 1.0 { std::f64::consts::LN_2 } else { channels - 1.0 / 3.0 + 8.0 / (405.0 * channels) }
}
