//! Sums of a map over rectangles around every cell of a row: Doppler wraps, range does not. A summed-area
//! table (integral image: Crow, SIGGRAPH 1984) of which only a band of rows is held, as in a box filter.
//!
//! Rows of one height are summed column by column and slide from row to row; their running sums along range
//! then yield a rectangle in two look-ups.

/// Sliding sums of a map for every height of rectangles.
pub(crate) struct BoxSums<'a> {
    power: &'a [f64],
    samples: usize,
    bands: Vec<Band>,
}

/// Sum of the rows around the current row.
struct Band {
    /// First and last offset.
    rows: [i64; 2],
    /// Sum of the rows in each column.
    of_column: Vec<f64>,
    /// Sum of all columns before each one.
    before: Vec<f64>,
}

impl<'a> BoxSums<'a> {
    /// Sums for rectangles with these row ranges, at the map's row `row`.
    pub(crate) fn at_row(power: &'a [f64], samples: usize, heights: &[[i64; 2]], row: usize) -> Self {
        let band = |rows: &[i64; 2]| Band {
            rows: *rows,
            of_column: vec![0.0; samples],
            before: vec![0.0; samples + 1],
        };
        let mut sums = Self { power, samples, bands: heights.iter().map(band).collect() };
        for band in &mut sums.bands {
            for offset in band.rows[0]..=band.rows[1] {
                add(&mut band.of_column, row_of(power, samples, row, offset));
            }
            band.add_along();
        }
        sums
    }

    /// Advances from `row` to the next.
    pub(crate) fn slide_from(&mut self, row: usize) {
        let of = |offset: i64| row_of(self.power, self.samples, row, offset);
        for band in &mut self.bands {
            let (leaves, enters) = (of(band.rows[0]), of(band.rows[1] + 1));
            let change = leaves.iter().zip(enters);
            band.of_column.iter_mut().zip(change).for_each(|(sum, (leaves, enters))| *sum += enters - leaves);
            band.add_along();
        }
    }

    /// Power from column `first` up to but excluding `behind_last`, in the rows of the height with this
    /// index.
    #[inline]
    pub(crate) fn sum(&self, height: usize, first: usize, behind_last: usize) -> f64 {
        let before = &self.bands[height].before;
        before[behind_last] - before[first]
    }
}

impl Band {
    fn add_along(&mut self) {
        let mut sum = 0.0;
        for (before, value) in self.before[1..].iter_mut().zip(&self.of_column) {
            sum += value;
            *before = sum;
        }
    }
}

fn row_of(power: &[f64], samples: usize, row: usize, offset: i64) -> &[f64] {
    let chirps = (power.len() / samples) as i64;
    let at = (row as i64 + offset).rem_euclid(chirps) as usize;
    &power[at * samples..(at + 1) * samples]
}

fn add(sums: &mut [f64], values: &[f64]) {
    sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rectangle_around_any_cell_is_what_its_cells_add_up_to() {
        let (chirps, samples) = (9_usize, 7_usize);
        let power: Vec<f64> = (0..chirps * samples).map(|i| ((i as f64 + 1.0) * 0.618_034).fract()).collect();
        let heights = [[-3, 3], [-1, 1], [2, 4]];
        let mut sums = BoxSums::at_row(&power, samples, &heights, 0);
        for row in 0..chirps {
            for (column, height, range) in [(3, 0, [-3, 3]), (0, 1, [0, 2]), (6, 2, [-5, 0])] {
                let rows = heights[height];
                let cell = |(r, c): (i64, i64)| {
                    let row = (row as i64 + r).rem_euclid(chirps as i64) as usize;
                    power[row * samples + (column as i64 + c) as usize]
                };
                let cells = (rows[0]..=rows[1]).flat_map(|r| (range[0]..=range[1]).map(move |c| (r, c)));
                let asked: f64 = cells.map(cell).sum();
                let place = |offset: i64| (column as i64 + offset) as usize;
                let found = sums.sum(height, place(range[0]), place(range[1] + 1));
                assert!((found - asked).abs() < 1e-12 * asked);
            }
            sums.slide_from(row);
        }
    }
}
