//! The whole map as a grayscale image, as in the paper.

use crate::crops::crop::{PAPER_CROP, grey};
use crate::error::DspError;
use crate::spectrum::noncoherent::PowerLevels;
use crate::spectrum::shapes::Shapes;
use artifact::cube::CubeHeader;
use artifact::rdm::RdmFrame;
use ndarray::ArrayView2;

/// Noncoherent sum of a map as 451 × 451 grey levels, row-major `[velocity, range]`, velocity growing
/// downwards.
///
/// Grey 0 is the noise, 255 is 70 dB above it, as in [`PAPER_CROP`]; levels are interpolated linearly in
/// power. Pixel centres span from half a cell before the first to half a cell after the last; beyond the
/// outermost cell centres, values are constant.
pub fn rdm_grayscale(header: &CubeHeader, map: &RdmFrame) -> Result<Vec<u8>, DspError> {
    let levels = PowerLevels::of(&Shapes::of(header)?, map)?;
    let (power, noise) = (levels.power(), levels.noise() * header.radar.map_channels() as f64);
    let (rows, columns) = power.dim();
    let side = PAPER_CROP.side as usize;
    let place = |pixel: usize, cells: usize| (pixel as f64 + 0.5) * cells as f64 / side as f64 - 0.5;
    let pixel = |(row, column)| {
        let level = between(power, place(row, rows), place(column, columns));
        grey(level, noise, &PAPER_CROP)
    };
    Ok((0..side * side).map(|i| pixel((i / side, i % side))).collect())
}

fn between(power: ArrayView2<f64>, row: f64, column: f64) -> f64 {
    let (rows, columns) = power.dim();
    let ([top, bottom], down) = neighbours(row, rows);
    let ([left, right], across) = neighbours(column, columns);
    let along = |row: usize| power[(row, left)] * (1.0 - across) + power[(row, right)] * across;
    along(top) * (1.0 - down) + along(bottom) * down
}

/// Cells before and after a position, and the weight of the later one.
fn neighbours(place: f64, cells: usize) -> ([usize; 2], f64) {
    let place = place.clamp(0.0, (cells - 1) as f64);
    let low = place.floor() as usize;
    ([low, (low + 1).min(cells - 1)], place - place.floor())
}
