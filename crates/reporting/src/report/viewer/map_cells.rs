//! Range-Doppler map of a frame for the view: levels relative to the noise, the detector's mask and the
//! origin of the strongest echo in each cell.

use crate::report::viewer::packed::Packed;
use artifact::cube::CubeHeader;
use artifact::paths::PathsFrame;
use artifact::units::db_from_power;
use evaluation::{CellOrigins, EchoGroup, cell_origins};
use pipeline::chain::link::FrameProducts;
use pipeline::host::failure::Failure;
use serde::Serialize;

/// A map, row-major `[doppler, range]`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct MapCells {
    rows: usize,
    columns: usize,
    /// Range of the first column, and column spacing, m.
    range_m: [f64; 2],
    /// Velocity of the first row, and row spacing, m/s.
    velocity_mps: [f64; 2],
    /// Level of the noise of one cell, all channels together, dBW.
    noise_dbw: f64,
    /// Whether a floor replaces the missing noise.
    floor_is_assumed: bool,
    /// Levels relative to the noise, dB.
    levels_db: Packed,
    /// Verdict of the detector: 0 untested, 1 tested, 2 detected.
    mask: Packed,
    /// Kind of the strongest echo in each cell, counted from 1; 0: none above the noise.
    strongest: Packed,
    /// Power of that kind relative to the sum over all kinds in the cell, percent.
    percent: Packed,
    kinds: Vec<EchoKind>,
    /// Cells of the map along both axes per cell here, which shows the strongest of them.
    pooled: usize,
}

/// Kind of echo.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct EchoKind {
    target: u32,
    order: u8,
    bodies: u8,
}

/// Precision of levels, dB.
const STEP_DB: f64 = 0.01;
/// Lowest level shown, dB over the noise.
const LOWEST_DB: f64 = -60.0;

impl MapCells {
    /// The map of a frame in a limited number of cells; `paths` includes those of the ground.
    pub(super) fn of(
        header: &CubeHeader,
        frame: &FrameProducts,
        paths: Option<&PathsFrame>,
        most: usize,
    ) -> Result<Self, Failure> {
        let power = dsp::power_map(header, &frame.rdm).map_err(Failure::refused)?;
        let noise = dsp::noise_power(header, &frame.rdm).map_err(Failure::refused)?;
        let floor = noise * header.radar.map_channels() as f64;
        let levels: Vec<f64> = power.iter().map(|p| db_from_power(p / floor).max(LOWEST_DB)).collect();
        let origins = paths.map(|paths| cell_origins(header, paths, noise)).transpose();
        let origins = origins.map_err(Failure::refused)?.unwrap_or_else(|| unknown_origins(levels.len()));
        let pool = MaxPooling::of(power.dim(), most);
        let strongest = pool.strongest(&levels);
        let bytes = |values: &[u8]| Packed::bytes(&picked(&strongest, values));
        let kind =
            |group: &EchoGroup| EchoKind { target: group.target, order: group.order, bodies: group.bodies };
        Ok(Self {
            rows: pool.rows(),
            columns: pool.columns(),
            range_m: pool.axis(&dsp::range_axis_m(header), header.radar.waveform.range_resolution_m()),
            velocity_mps: pool.axis(&dsp::velocity_axis_mps(header), header.radar.velocity_resolution_mps()),
            noise_dbw: db_from_power(floor),
            floor_is_assumed: frame.rdm.assumed_floor.is_some(),
            levels_db: Packed::steps(
                &strongest.iter().map(|cell| levels[*cell]).collect::<Vec<_>>(),
                STEP_DB,
            ),
            mask: bytes(&frame.rdm.mask),
            strongest: Packed::numbers(&picked(&strongest, &origins.strongest)),
            percent: bytes(&origins.percent),
            kinds: origins.groups.iter().map(kind).collect(),
            pooled: pool.side,
        })
    }
}

/// Values of some cells; 0 for a cell without one.
fn picked<T: Copy + Default>(cells: &[usize], values: &[T]) -> Vec<T> {
    cells.iter().map(|cell| values.get(*cell).copied().unwrap_or_default()).collect()
}

/// Labels of a map whose echoes are unknown.
fn unknown_origins(cells: usize) -> CellOrigins {
    CellOrigins { groups: vec![], strongest: vec![0; cells], percent: vec![0; cells] }
}

/// Squares of cells, each represented by its strongest cell.
struct MaxPooling {
    size: (usize, usize),
    side: usize,
}

impl MaxPooling {
    /// Smallest squares with which the map has at most `most`.
    fn of(size: (usize, usize), most: usize) -> Self {
        let pools = (1..).map(|side| Self { size, side });
        let fits = |pool: &Self| pool.rows() * pool.columns() <= most.max(1);
        pools.into_iter().find(fits).unwrap_or(Self { size, side: 1 })
    }

    fn rows(&self) -> usize {
        self.size.0.div_ceil(self.side)
    }

    fn columns(&self) -> usize {
        self.size.1.div_ceil(self.side)
    }

    /// Index of the strongest cell of each square.
    fn strongest(&self, levels: &[f64]) -> Vec<usize> {
        let squares = (0..self.rows()).flat_map(|row| (0..self.columns()).map(move |column| [row, column]));
        let strongest = |square: [usize; 2]| {
            let cells = self.cells(square);
            cells.max_by(|a, b| levels[*a].total_cmp(&levels[*b]).then(b.cmp(a))).unwrap_or(0)
        };
        squares.map(strongest).collect()
    }

    fn cells(&self, [row, column]: [usize; 2]) -> impl Iterator<Item = usize> {
        let span = |at: usize, end: usize| at * self.side..((at + 1) * self.side).min(end);
        let (columns, across) = (self.size.1, span(column, self.size.1));
        span(row, self.size.0).flat_map(move |r| across.clone().map(move |c| r * columns + c))
    }

    /// Place of the first square's middle on an axis, and the spacing; a single cell is as wide as the
    /// resolution.
    fn axis(&self, cells: &[f64], resolution: f64) -> [f64; 2] {
        let step = if cells.len() > 1 { cells[1] - cells[0] } else { resolution };
        let side = self.side as f64;
        [cells.first().copied().unwrap_or(0.0) + 0.5 * (side - 1.0) * step, side * step]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_that_is_too_large_shows_the_strongest_cell_of_each_square() {
        let levels = [0.0, 5.0, 1.0, 2.0, 3.0, 4.0, 7.0, 1.0, 2.0, 9.0, 0.0, 8.0];
        let pool = MaxPooling::of((3, 4), 4);
        assert_eq!((pool.side, pool.rows(), pool.columns()), (2, 2, 2));
        // Rows: 0 5 1 2 / 3 4 7 1 / 2 9 0 8.
        assert_eq!(pool.strongest(&levels), [1, 6, 9, 11]);
        assert_eq!(pool.axis(&[0.0, 2.0, 4.0, 6.0], 2.0), [1.0, 4.0]);
        assert_eq!(MaxPooling::of((1, 4), 4).axis(&[0.0], 86.0), [0.0, 86.0]);
        assert_eq!(MaxPooling::of((3, 4), 12).strongest(&levels), (0..12).collect::<Vec<_>>());
    }
}
