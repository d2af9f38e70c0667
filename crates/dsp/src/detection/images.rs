//! Places of the images of cells in maps of real samples: the cell at (−m, −k) is the conjugate of that at
//! (m, k).

use crate::detection::correlated_cells::FAR_CELLS;
use artifact::cube::CubeHeader;
use artifact::radar::{Multiplexing, Sampling};

/// Distances from cells to their images, as far as training regions can meet their images there.
pub(crate) struct Images {
    /// Doppler offsets of images: of rows from which they are too far (`None`), and each one that is near.
    pub(crate) kinds: Vec<Option<i64>>,
    /// Index in `kinds` of each row's offset.
    pub(crate) of_rows: Vec<usize>,
    /// Samples, of which half are range cells; 0 where there are no images.
    samples: i64,
    /// Farthest range offset.
    far: i64,
}

impl Images {
    /// Finds the images that training regions of these half sizes can meet.
    ///
    /// Under Doppler division a channel's image lies on other rows, by the sum of its own and another
    /// transmitter's band, and at each of them it meets only one of many pairs of channels: it is left out.
    pub(crate) fn new(header: &CubeHeader, outer: [usize; 2]) -> Self {
        let waveform = &header.radar.waveform;
        let chirps = waveform.chirps as usize;
        let has = waveform.sampling == Sampling::Real && header.radar.array.multiplexing != Multiplexing::Ddm;
        let [far_rows, far] = outer.map(|half| (2 * half + FAR_CELLS) as i64);
        // Regions are alike above and below a row, so that the side on which the image lies does not matter.
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

/// Row of the conjugate of a row's cells, as far on the other side of zero velocity.
pub(crate) fn conjugate_row(row: usize, rows: usize) -> usize {
    (2 * (rows / 2) + rows - row) % rows
}

/// The smallest of an offset's values on a circle.
fn nearest(offset: i64, circle: i64) -> i64 {
    let up = offset.rem_euclid(circle);
    if 2 * up > circle { up - circle } else { up }
}
