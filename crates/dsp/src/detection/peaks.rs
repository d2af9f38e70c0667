//! Peaks: strong cells that no neighbour exceeds, placed between cells, without the sidelobes of stronger
//! peaks.
//!
//! Beside detected cells, those count that the map's own noise level would have let pass: a vehicle fills the
//! training cells of its own echoes, and cell averaging then hides the weaker ones between the stronger (a
//! gap of 2.8 m in a car of 5 m). They make no points, but they tell that what lies on both sides of them is
//! one body.

use crate::detection::cfar::DETECTED;
use crate::detection::interpolation::{Interpolator, Trio};
use crate::detection::leakage::Leakage;
use crate::spectrum::map_cells::MapCells;
use artifact::Radar;
use ndarray::ArrayView2;
use num_complex::{Complex32, Complex64};

/// A local maximum of a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Peak {
    /// Doppler cell.
    pub(crate) row: usize,
    /// Range cell.
    pub(crate) column: usize,
    /// Interpolated Doppler cell.
    pub(crate) fine_row: f64,
    /// Interpolated range cell.
    pub(crate) fine_column: f64,
    /// Power of the cell.
    pub(crate) power: f64,
    /// Detected cells among it and its eight neighbours.
    pub(crate) cells: u32,
    /// Whether the detector found it, or its neighbours' echoes hid it.
    pub(crate) detected: bool,
    /// Cell of the peak on whose slope it stands; its own cell where it stands on none
    /// (`directional_peaks.rs`).
    pub(crate) summit: [usize; 2],
}

impl Peak {
    /// A detected cell on a slope, taken at its centre.
    pub(crate) fn at_centre(row: usize, column: usize, power: f64) -> Self {
        Self {
            row,
            column,
            fine_row: row as f64,
            fine_column: column as f64,
            power,
            cells: 1,
            detected: true,
            summit: [row, column],
        }
    }
}

/// Peak curves and sidelobe levels of a radar's two windows.
pub(crate) struct PeakFinder {
    cells: MapCells,
    interpolators: [Interpolator; 2],
    leakage: Leakage,
}

/// A peak this little above the leakage of stronger ones is taken for leakage: two leaks in phase double
/// their power.
pub(crate) const LEAKAGE_MARGIN: f64 = 2.0;
/// Leakage near the noise's level passes with what noise adds to it: it has to be passed by as much as noise
/// alone hardly passes, from this part of that on; below, noise is what the detector judged it by.
const LEAKAGE_IN_NOISE: f64 = 0.05;

impl PeakFinder {
    /// Prepares for maps that were made with these windows.
    pub(crate) fn new(radar: &Radar, doppler: &[f64], range: &[f64]) -> Self {
        Self {
            cells: MapCells::of(radar),
            interpolators: [Interpolator::new(doppler), Interpolator::new(range)],
            leakage: Leakage::new(radar, doppler, range),
        }
    }

    /// Peaks of a power map `[doppler, range]` among the cells that the mask calls detected and those above
    /// `noise_threshold`, strongest first; `values` `[channel, doppler, range]` tell where between cells they
    /// lie.
    pub(crate) fn peaks(
        &self,
        power: ArrayView2<f64>,
        values: &[Complex32],
        mask: &[u8],
        noise_threshold: f64,
    ) -> Vec<Peak> {
        let strong =
            power.indexed_iter().zip(mask).filter(|((_, p), m)| **m == DETECTED || **p > noise_threshold);
        let mut peaks: Vec<Peak> = strong
            .map(|(((row, column), _), _)| [row, column])
            .filter(|cell| self.is_local_maximum(power, *cell))
            .map(|cell| self.place(power, values, mask, cell))
            .collect();
        peaks.sort_by(|a, b| b.power.total_cmp(&a.power).then((a.row, a.column).cmp(&(b.row, b.column))));
        self.without_sidelobes(peaks, noise_threshold)
    }

    /// Detected cells and the peak whose slope each stands on, in row-major order; those that climb to a
    /// sidelobe are left out.
    pub(crate) fn slopes(
        &self,
        power: ArrayView2<f64>,
        mask: &[u8],
        peaks: &[Peak],
    ) -> Vec<([usize; 2], usize)> {
        let (rows, columns) = power.dim();
        let mut peak_at = vec![None; rows * columns];
        peaks
            .iter()
            .enumerate()
            .for_each(|(index, peak)| peak_at[peak.row * columns + peak.column] = Some(index));
        let detected = (0..rows * columns).filter(|cell| mask[*cell] == DETECTED);
        detected
            .filter_map(|cell| {
                let [row, column] = self.summit(power, [cell / columns, cell % columns]);
                peak_at[row * columns + column].map(|peak| ([cell / columns, cell % columns], peak))
            })
            .collect()
    }

    fn place(
        &self,
        power: ArrayView2<f64>,
        values: &[Complex32],
        mask: &[u8],
        [row, column]: [usize; 2],
    ) -> Peak {
        let (rows, columns) = power.dim();
        let trios = |cells: [[usize; 2]; 3]| {
            values
                .chunks_exact(rows * columns)
                .map(move |channel| trio(channel, cells.map(|[r, c]| r * columns + c)))
        };
        let offset = |(cells, interpolator): (Option<[[usize; 2]; 3]>, &Interpolator)| {
            cells.map_or(0.0, |cells| interpolator.offset(trios(cells)))
        };
        let [along_rows, along_columns] = self.cells.trios([row, column]);
        let is_detected = |[r, c]: [usize; 2]| mask[r * columns + c] == DETECTED;
        let neighbours = self.cells.around([row, column]).filter(|cell| is_detected(*cell)).count();
        Peak {
            row,
            column,
            fine_row: row as f64 + offset((along_rows, &self.interpolators[0])),
            fine_column: column as f64 + offset((along_columns, &self.interpolators[1])),
            power: power[(row, column)],
            cells: neighbours as u32 + u32::from(is_detected([row, column])),
            detected: is_detected([row, column]),
            summit: [row, column],
        }
    }

    /// Drops peaks that the leakage of stronger kept ones explains.
    fn without_sidelobes(&self, peaks: Vec<Peak>, noise_threshold: f64) -> Vec<Peak> {
        let mut kept: Vec<Peak> = Vec::new();
        for peak in peaks {
            let leaked: f64 =
                kept.iter().map(|strong| strong.power * self.leak(strong, [peak.row, peak.column])).sum();
            let with_noise = noise_threshold.min(leaked / LEAKAGE_IN_NOISE);
            if peak.power > LEAKAGE_MARGIN * leaked + with_noise {
                kept.push(peak);
            }
        }
        kept
    }

    /// Largest share of a peak's power in a cell.
    pub(crate) fn leak(&self, from: &Peak, cell: [usize; 2]) -> f64 {
        self.leakage.share([from.row, from.column], cell)
    }

    /// Whether a cell is a peak among its neighbours: of equal ones the first in row-major order is.
    fn is_local_maximum(&self, power: ArrayView2<f64>, cell: [usize; 2]) -> bool {
        self.cells.around(cell).all(|other| exceeds(power, cell, other))
    }

    /// The local maximum that the steepest climb from a cell reaches.
    fn summit(&self, power: ArrayView2<f64>, mut cell: [usize; 2]) -> [usize; 2] {
        // Of equal powers the first cell counts as the higher one: every step climbs, and the walk ends.
        while !self.is_local_maximum(power, cell) {
            let steeper = |a: [usize; 2], b: [usize; 2]| if exceeds(power, b, a) { b } else { a };
            cell = self.cells.around(cell).fold(cell, steeper);
        }
        cell
    }

    /// Offsets from the middle of three values along rows and along columns; 0 where there are none.
    pub(crate) fn offsets(&self, [along_rows, along_columns]: [Option<Trio>; 2]) -> [f64; 2] {
        let offset = |axis: usize, trio: Option<Trio>| {
            trio.map_or(0.0, |t| self.interpolators[axis].offset([t].into_iter()))
        };
        [offset(0, along_rows), offset(1, along_columns)]
    }
}

fn trio(channel: &[Complex32], cells: [usize; 3]) -> Trio {
    cells.map(|cell| Complex64::new(f64::from(channel[cell].re), f64::from(channel[cell].im)))
}

fn exceeds(power: ArrayView2<f64>, a: [usize; 2], b: [usize; 2]) -> bool {
    power[a] > power[b] || (power[a] == power[b] && a < b)
}
