//! Neighbourhood of a map's cells, on axes that may be circular.
//!
//! The spectrum over chirps is periodic, so the Doppler axis is a circle. The spectrum over complex samples
//! is periodic too: a tone between the last range cell and the first fills both. For real samples the axis is
//! one half of the circle, and beyond its ends lies its own image (`docs/scenes.md`).

use artifact::Radar;
use artifact::radar::Sampling;

/// Topology of the range axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RangeAxis {
    /// The last cell is adjacent to the first: complex samples.
    Circle,
    /// Both ends have a neighbour on one side only: real samples.
    Segment,
}

/// Cells of a map and their adjacency.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct MapCells {
    rows: usize,
    columns: usize,
    range: RangeAxis,
}

/// A cell, `[doppler, range]`.
type Cell = [usize; 2];

impl RangeAxis {
    /// Topology of a radar's range axis.
    pub(crate) fn of(radar: &Radar) -> Self {
        match radar.waveform.sampling {
            Sampling::Complex => Self::Circle,
            Sampling::Real => Self::Segment,
        }
    }
}

impl MapCells {
    /// Cells of a radar's maps.
    pub(crate) fn of(radar: &Radar) -> Self {
        let (rows, columns) = (radar.waveform.chirps as usize, radar.waveform.range_cells());
        Self { rows, columns, range: RangeAxis::of(radar) }
    }

    /// Number of Doppler cells.
    pub(crate) fn rows(self) -> usize {
        self.rows
    }

    /// The up to eight cells around a cell.
    pub(crate) fn around(self, cell: Cell) -> impl Iterator<Item = Cell> {
        let steps = [(-1, -1), (-1, 0), (-1, 1), (0, -1), (0, 1), (1, -1), (1, 0), (1, 1)];
        let beside =
            move |(down, right)| Some([stepped(cell[0], down, self.rows), self.column(cell[1], right)?]);
        steps.into_iter().filter_map(beside).filter(move |other| *other != cell)
    }

    /// The cell before a cell, itself and the one after it, along rows and along columns; `None` at an end,
    /// and where there are fewer than three.
    pub(crate) fn trios(self, [row, column]: Cell) -> [Option<[Cell; 3]>; 2] {
        let along_rows =
            (self.rows > 2).then(|| [-1, 0, 1].map(|step| [stepped(row, step, self.rows), column]));
        let ends = (self.columns > 2).then(|| [-1, 1].map(|step| self.column(column, step)));
        let along_columns = match ends {
            Some([Some(before), Some(after)]) => Some([before, column, after].map(|column| [row, column])),
            _ => None,
        };
        [along_rows, along_columns]
    }

    /// Distance in rows and columns between two cells, the shorter way round.
    pub(crate) fn apart(self, from: Cell, to: Cell) -> [usize; 2] {
        let [rows, columns] = [0, 1].map(|axis: usize| from[axis].abs_diff(to[axis]));
        let columns = match self.range {
            RangeAxis::Circle => columns.min(self.columns - columns),
            RangeAxis::Segment => columns,
        };
        [rows.min(self.rows - rows), columns]
    }

    fn column(self, column: usize, step: isize) -> Option<usize> {
        match self.range {
            RangeAxis::Circle => Some(stepped(column, step, self.columns)),
            RangeAxis::Segment => column.checked_add_signed(step).filter(|next| *next < self.columns),
        }
    }
}

/// Index on a circle of `count`, one step forwards or backwards.
fn stepped(place: usize, step: isize, count: usize) -> usize {
    (place + count).saturating_add_signed(step) % count
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(range: RangeAxis) -> MapCells {
        MapCells { rows: 4, columns: 6, range }
    }

    #[test]
    fn a_corner_of_a_circle_has_eight_neighbours_and_one_of_a_segment_five() {
        let around = |range| cells(range).around([0, 5]).collect::<Vec<_>>();
        assert_eq!(
            around(RangeAxis::Circle),
            [[3, 4], [3, 5], [3, 0], [0, 4], [0, 0], [1, 4], [1, 5], [1, 0]]
        );
        assert_eq!(around(RangeAxis::Segment), [[3, 4], [3, 5], [0, 4], [1, 4], [1, 5]]);
    }

    #[test]
    fn three_cells_in_a_row_close_over_the_end_of_a_circle_alone() {
        let trios = |range| cells(range).trios([3, 0]);
        let rows = Some([[2, 0], [3, 0], [0, 0]]);
        assert_eq!(trios(RangeAxis::Circle), [rows, Some([[3, 5], [3, 0], [3, 1]])]);
        assert_eq!(trios(RangeAxis::Segment), [rows, None]);
        assert_eq!(cells(RangeAxis::Circle).apart([0, 0], [3, 4]), [1, 2]);
        assert_eq!(cells(RangeAxis::Segment).apart([0, 0], [3, 4]), [1, 4]);
    }
}
