//! Places where the sums of a cell's training cells are looked up, worked out once for all maps of a
//! detector.

use crate::detection::correlated_cells::{Rectangle, Region};
use crate::numerics::summed_area_table::BoxSums;

/// Places of one region of one cell: two in running sums of its rectangle, and two of the rectangle left out.
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
    /// Around a column; `heights` are the rows that are summed.
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

    /// Mean of powers, which rounding does not make negative.
    #[inline]
    pub(crate) fn mean(&self, sums: &BoxSums<'_>) -> f64 {
        self.sum(sums).max(0.0) / self.cells
    }
}
