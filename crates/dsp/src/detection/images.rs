//! Image cells in maps of real samples: the cell at (−m, −k) is the conjugate of that at (m, k).

use crate::detection::correlated_cells::FAR_CELLS;
use artifact::cube::CubeHeader;
use artifact::radar::{Multiplexing, Sampling};

/// Distances from cells to their images, as far as training regions can overlap their images.
pub(crate) struct Images {
    /// Distinct Doppler offsets of images: `None` for rows that are too far away, and each near offset.
    pub(crate) kinds: Vec<Option<i64>>,
    /// Index in `kinds` of each row's offset.
    pub(crate) of_rows: Vec<usize>,
    /// Number of samples, half of which are range cells; 0 if there are no images.
    samples: i64,
    /// Largest range offset of an image that training regions can overlap.
    far: i64,
}

impl Images {
    /// Finds the images that training regions of these half sizes can overlap.
    ///
    /// Under Doppler division a channel's image lies on other rows, shifted by the sum of its own and another
    /// transmitter's band, and at each of them it overlaps only one of many pairs of channels: this is
    /// neglected.
    pub(crate) fn new(header: &CubeHeader, outer: [usize; 2]) -> Self {
        let waveform = &header.radar.waveform;
        let chirps = waveform.chirps as usize;
        let has = waveform.sampling == Sampling::Real && header.radar.array.multiplexing != Multiplexing::Ddm;
        let [far_rows, far] = outer.map(|half| (2 * half + FAR_CELLS) as i64);
        // Regions are symmetric above and below a row, so the side on which the image lies is irrelevant.
        let row_image =
            |row: usize| nearest(row as i64 - conjugate_row(row, chirps) as i64, chirps as i64).abs();
        let of_row = |row: usize| Some(row_image(row)).filter(|image| has && *image <= far_rows);
        let mut kinds: Vec<Option<i64>> = std::iter::once(None).chain((0..chirps).map(of_row)).collect();
        kinds.sort_unstable();
        kinds.dedup();
        let of_rows = (0..chirps).map(|row| kinds.binary_search(&of_row(row)).unwrap_or_default()).collect();
        Self { kinds, of_rows, samples: if has { i64::from(waveform.samples) } else { 0 }, far }
    }

    /// Range offset of a column's images.
    pub(crate) fn of_column(&self, column: usize) -> Option<i64> {
        let image = || nearest(-2 * column as i64, self.samples);
        (self.samples > 0).then(image).filter(|image| image.abs() <= self.far)
    }
}

/// Row of the conjugate of a row's cells, mirrored at zero velocity.
pub(crate) fn conjugate_row(row: usize, rows: usize) -> usize {
    (2 * (rows / 2) + rows - row) % rows
}

/// An offset wrapped on a circle to the value nearest to zero.
fn nearest(offset: i64, circle: i64) -> i64 {
    let up = offset.rem_euclid(circle);
    if 2 * up > circle { up - circle } else { up }
}
