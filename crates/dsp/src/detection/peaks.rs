//! Peaks: strong cells that no neighbour exceeds, interpolated between cells, without the sidelobes of
//! stronger peaks.
//!
//! Besides detected cells, those count that pass a threshold over the map's own noise level: a vehicle fills
//! the training cells of its own echoes, so cell averaging hides the weaker ones between the stronger (a gap
//! of 2.8 m in a car of 5 m). They yield no points, but show that the echoes on both sides of them are one
//! body.

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
    /// Number of detected cells among it and its eight neighbours.
    pub(crate) cells: u32,
    /// Whether the detector found it; if not, echoes of its neighbours hid it.
    pub(crate) detected: bool,
    /// Cell of the peak on whose slope it lies; its own cell if it lies on none (`directional_peaks.rs`).
    pub(crate) summit: [usize; 2],
}

impl Peak {
    /// A detected cell on a slope, placed at its centre.
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

/// Interpolation curves and sidelobe levels of a radar's two windows.
pub(crate) struct PeakFinder {
    cells: MapCells,
    interpolators: [Interpolator; 2],
    leakage: Leakage,
}

/// Power ratio over the leakage of stronger peaks up to which a peak is taken for leakage: two leaks in phase
/// double their power.
pub(crate) const LEAKAGE_MARGIN: f64 = 2.0;
/// Share of the noise threshold from which leakage has to be exceeded by the full threshold too, since noise
/// adds to it; below, the detector's comparison with noise suffices.
const LEAKAGE_IN_NOISE: f64 = 0.05;

impl PeakFinder {
    /// Prepares for maps made with these windows.
    pub(crate) fn new(radar: &Radar, doppler: &[f64], range: &[f64]) -> Self {
        Self {
            cells: MapCells::of(radar),
            interpolators: [Interpolator::new(doppler), Interpolator::new(range)],
            leakage: Leakage::new(radar, doppler, range),
        }
    }

    /// Peaks of a power map `[doppler, range]` among the cells marked as detected and those above
    /// `noise_threshold`, strongest first; `values` `[channel, doppler, range]` determine their positions
    /// between cells.
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

    /// Detected cells and the peak on whose slope each lies, in row-major order; those that climb to a
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

    /// Drops peaks explained by the leakage of stronger kept ones.
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

    /// Maximum share of a peak's power in a cell.
    pub(crate) fn leak(&self, from: &Peak, cell: [usize; 2]) -> f64 {
        self.leakage.share([from.row, from.column], cell)
    }

    /// Whether a cell is a peak among its neighbours; of equal ones the first in row-major order is.
    fn is_local_maximum(&self, power: ArrayView2<f64>, cell: [usize; 2]) -> bool {
        self.cells.around(cell).all(|other| exceeds(power, cell, other))
    }

    /// Local maximum reached by steepest ascent from a cell.
    fn summit(&self, power: ArrayView2<f64>, mut cell: [usize; 2]) -> [usize; 2] {
        // Among equal powers the first cell counts as the higher one: every step climbs, so the walk ends.
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
