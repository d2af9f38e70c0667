//! Peaks: strong cells that no neighbour exceeds, interpolated between cells, without the sidelobes of
//! stronger peaks.
//!
//! Besides detected cells, those count that pass a threshold over the map's own noise level: a vehicle fills
//! the training cells of its own echoes, so cell averaging hides the weaker ones between the stronger (a gap
//! of 2.8 m in a car of 5 m). They yield no points, but show that the echoes on both sides of them are one
//! body.

use crate::detection::cfar::DETECTED;
use crate::detection::empty_band::EmptyBands;
use crate::detection::interpolation::{Interpolator, Sides, Trio};
use crate::detection::leakage::Leakage;
use crate::spectrum::code_division;
use crate::spectrum::division::Division;
use crate::spectrum::map_cells::MapCells;
use artifact::Radar;
use artifact::radar::Multiplexing;
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
    /// Whether the detector found it, or why not.
    pub(crate) finding: Finding,
    /// Cell of the peak on whose slope it lies; its own cell if it lies on none (`directional_peaks.rs`).
    pub(crate) summit: [usize; 2],
}

/// Whether a detector finds a peak.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Finding {
    /// It does.
    Detected,
    /// It does not: echoes of the peak's neighbours hide it.
    Hidden,
    /// It does not: the peak is another fold of an echo under Doppler division.
    WrongFold,
}

impl Peak {
    /// Whether the detector found it.
    pub(crate) fn is_detected(&self) -> bool {
        self.finding == Finding::Detected
    }

    /// A detected cell on a slope, placed at its centre.
    pub(crate) fn at_centre(row: usize, column: usize, power: f64) -> Self {
        Self {
            row,
            column,
            fine_row: row as f64,
            fine_column: column as f64,
            power,
            cells: 1,
            finding: Finding::Detected,
            summit: [row, column],
        }
    }
}

/// Interpolation curves and sidelobe levels of a radar's two windows.
pub(crate) struct PeakFinder {
    cells: MapCells,
    division: Division,
    /// Whether rows are the spectrum of chirps at unequal times, which has no period.
    is_staggered: bool,
    interpolators: [Interpolator; 2],
    leakage: Leakage,
    empty_bands: Option<EmptyBands>,
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
            division: Division::of(radar),
            is_staggered: !radar.schedule.is_uniform(),
            interpolators: [Interpolator::new(doppler), Interpolator::new(range)],
            leakage: Leakage::new(radar, doppler, range),
            empty_bands: EmptyBands::of(radar),
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
    /// sidelobe are left out. Some may themselves lie on a sidelobe ([`Self::is_sidelobe`]).
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

    /// Whether a cell on the slope of a peak lies beyond its main lobe and is explained by its leakage: half
    /// a cell off, the sidelobes of a rectangular window fall as steadily as a slope. The main lobe of a
    /// wrong fold counts too: where it is as weak as the sidelobes in its empty band, cells pass for a true
    /// fold.
    pub(crate) fn is_sidelobe(
        &self,
        (cell, power): ([usize; 2], f64),
        peak: &Peak,
        noise_threshold: f64,
    ) -> bool {
        let from = [peak.row, peak.column];
        let share = match peak.finding {
            Finding::WrongFold => Some(self.leakage.share(from, cell)),
            Finding::Detected | Finding::Hidden => {
                self.leakage.share_beyond_lobe(from, [peak.fine_row, peak.fine_column], cell)
            }
        };
        share.is_some_and(|share| power <= most_leaked(share * peak.power, noise_threshold))
    }

    fn place(
        &self,
        power: ArrayView2<f64>,
        values: &[Complex32],
        mask: &[u8],
        [row, column]: [usize; 2],
    ) -> Peak {
        let columns = power.ncols();
        let is_detected = |[r, c]: [usize; 2]| mask[r * columns + c] == DETECTED;
        let neighbours = self.cells.around([row, column]).filter(|cell| is_detected(*cell)).count();
        let is_wrong_fold =
            || self.empty_bands.as_ref().is_some_and(|bands| bands.is_wrong_fold(values, [row, column]));
        let finding = if is_detected([row, column]) {
            Finding::Detected
        } else if is_wrong_fold() {
            Finding::WrongFold
        } else {
            Finding::Hidden
        };
        let [off_row, off_column] = self.offsets_at(values, power.dim(), [row, column]);
        Peak {
            row,
            column,
            fine_row: row as f64 + off_row,
            fine_column: column as f64 + off_column,
            power: power[(row, column)],
            cells: neighbours as u32 + u32::from(is_detected([row, column])),
            finding,
            summit: [row, column],
        }
    }

    /// Offsets along rows and columns from the values of all channels.
    fn offsets_at(
        &self,
        values: &[Complex32],
        (rows, columns): (usize, usize),
        cell: [usize; 2],
    ) -> [f64; 2] {
        let channels = || values.chunks_exact(rows * columns);
        let at = |[row, column]: [usize; 2]| row * columns + column;
        let [along_rows, along_columns] = self.cells.trios(cell).map(|trio| trio.map(|cells| cells.map(at)));
        let offset = |axis: usize, sides: Sides, cells: [usize; 3]| {
            self.interpolators[axis].offset(sides, channels().map(|channel| trio(channel, cells)))
        };
        let of_rows = |cells: [usize; 3]| match self.division.multiplexing {
            Multiplexing::Bpm => {
                let codes = cells.map(|cell| channels().map(|channel| wide(channel[cell])).collect());
                self.offset_of_codes(codes, cells.map(|cell| cell / columns), rows)
            }
            _ => offset(0, self.sides(cell[0], rows), cells),
        };
        [along_rows.map_or(0.0, of_rows), along_columns.map_or(0.0, |cells| offset(1, Sides::Both, cells))]
    }

    /// Offset along rows from the codes of three cells, all separated as in the middle one's row.
    fn offset_of_codes(&self, codes: [Vec<Complex64>; 3], of_rows: [usize; 3], rows: usize) -> f64 {
        let turned =
            |i: usize| code_division::separated_as(&self.division, &codes[i], [of_rows[i], of_rows[1], rows]);
        let (before, after) = (turned(0), turned(2));
        let trios = before.into_iter().zip(&codes[1]).zip(after).map(|((b, here), a)| [b, *here, a]);
        self.interpolators[0].offset(Sides::Both, trios)
    }

    /// Rows beside a row that see a tone as it does: with staggered chirps those at both ends of the axis, at
    /// different frequencies, hold different sums of its chirps.
    fn sides(&self, row: usize, rows: usize) -> Sides {
        match row {
            0 if self.is_staggered => Sides::After,
            _ if self.is_staggered && row + 1 == rows => Sides::Before,
            _ => Sides::Both,
        }
    }

    /// Drops peaks explained by the leakage of stronger kept ones.
    fn without_sidelobes(&self, peaks: Vec<Peak>, noise_threshold: f64) -> Vec<Peak> {
        let mut kept: Vec<Peak> = Vec::new();
        for peak in peaks {
            let leaked: f64 =
                kept.iter().map(|strong| strong.power * self.leak(strong, [peak.row, peak.column])).sum();
            if peak.power > most_leaked(leaked, noise_threshold) {
                kept.push(peak);
            }
        }
        kept
    }

    /// Maximum share of a peak's power in a cell; none for a wrong fold, whose power is that of its echo,
    /// counted there.
    pub(crate) fn leak(&self, from: &Peak, cell: [usize; 2]) -> f64 {
        match from.finding {
            Finding::WrongFold => 0.0,
            Finding::Detected | Finding::Hidden => self.leakage.share([from.row, from.column], cell),
        }
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

    /// Offsets of a cell's peak from its middle along rows and along columns, from its values and those of
    /// its neighbours; 0 where there are none.
    pub(crate) fn offsets(&self, cell: [usize; 2], value: impl Fn([usize; 2]) -> Complex64) -> [f64; 2] {
        let sides = [self.sides(cell[0], self.cells.rows()), Sides::Both];
        let trios = self.cells.trios(cell);
        [0, 1].map(|axis: usize| {
            let offset = |cells: [[usize; 2]; 3]| {
                self.interpolators[axis].offset(sides[axis], [cells.map(&value)].into_iter())
            };
            trios[axis].map_or(0.0, offset)
        })
    }
}

/// Maximum power of a cell that is explained by this much leakage, with noise.
fn most_leaked(leaked: f64, noise_threshold: f64) -> f64 {
    LEAKAGE_MARGIN * leaked + noise_threshold.min(leaked / LEAKAGE_IN_NOISE)
}

fn trio(channel: &[Complex32], cells: [usize; 3]) -> Trio {
    cells.map(|cell| wide(channel[cell]))
}

fn wide(value: Complex32) -> Complex64 {
    Complex64::new(f64::from(value.re), f64::from(value.im))
}

fn exceeds(power: ArrayView2<f64>, a: [usize; 2], b: [usize; 2]) -> bool {
    power[a] > power[b] || (power[a] == power[b] && a < b)
}
