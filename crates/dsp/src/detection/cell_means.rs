//! Look-up positions for the sums over a cell's training cells, computed once for all maps of a detector.

use crate::detection::correlated_cells::{Rectangle, Region};
use crate::numerics::summed_area_table::BoxSums;

/// Positions for one region of one cell: two in the running sums of its rectangle, and two for the excluded
/// rectangle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LookUp {
    whole: Span,
    hole: Span,
    cells: f64,
}

/// Columns of rows that are summed together.
#[derive(Debug, Clone, Copy, Default)]
struct Span {
    band: u32,
    first: u32,
    behind_last: u32,
}

impl LookUp {
    /// Look-up for a region around a column; `heights` are the row ranges that are summed.
    pub(crate) fn of(region: &Region, column: usize, heights: &[[i64; 2]]) -> Self {
        let span = |[rows, range]: &Rectangle| {
            let place = |offset: i64| (column as i64 + offset) as u32;
            let band = heights.iter().position(|height| height == rows).unwrap_or_default() as u32;
            Span { band, first: place(range[0]), behind_last: place(range[1] + 1) }
        };
        let hole = region.hole.as_ref().map_or(Span::default(), span);
        Self { whole: span(&region.whole), hole, cells: region.cells() as f64 }
    }

    /// Number of the region's cells.
    pub(crate) fn cells(&self) -> f64 {
        self.cells
    }

    /// Sum over the region.
    #[inline]
    pub(crate) fn sum(&self, sums: &BoxSums<'_>) -> f64 {
        let of = |span: &Span| sums.sum(span.band as usize, span.first as usize, span.behind_last as usize);
        of(&self.whole) - of(&self.hole)
    }

    /// Mean power over the region, kept non-negative despite rounding.
    #[inline]
    pub(crate) fn mean(&self, sums: &BoxSums<'_>) -> f64 {
        self.sum(sums).max(0.0) / self.cells
    }
}
