//! Optimal assignment of rows to columns, the Hungarian or Kuhn–Munkres algorithm: shortest augmenting paths
//! with dual prices (Kuhn 1955, Munkres 1957; in the form of Jonker and Volgenant, Computing 38 (1987) 325).
//!
//! The cost is O(n²·(rows + columns)), n the smaller of both: microseconds for a dozen tracks and objects,
//! milliseconds for thousands of bodies and one object. A row may stay unassigned at a price, as needed for
//! gates and for the cut-off of a metric.

use ndarray::ArrayView2;

/// Assigns each row a column, or `None`, so that Σ of `costs[(row, column)]` over assigned rows plus
/// `unassigned` for every other row is minimal. Each column is used at most once.
///
/// A cost that is not finite, or not below `unassigned`, is never chosen. Ties are resolved
/// deterministically.
pub fn assignment(costs: ArrayView2<f64>, unassigned: f64) -> Vec<Option<usize>> {
    let (rows, columns) = costs.dim();
    if rows == 0 || !unassigned.is_finite() {
        return vec![None; rows];
    }
    if rows <= columns {
        return assign_fewer_rows(costs, unassigned);
    }
    let mut column_of = vec![None; rows];
    for (column, row) in assign_fewer_rows(costs.reversed_axes(), unassigned).into_iter().enumerate() {
        if let Some(row) = row {
            column_of[row] = Some(column);
        }
    }
    column_of
}

/// [`assignment`] for at least as many columns as rows.
fn assign_fewer_rows(costs: ArrayView2<f64>, unassigned: f64) -> Vec<Option<usize>> {
    let (rows, columns) = costs.dim();
    // Every row has an additional column of its own that stands for no assignment.
    let cost = |row: usize, column: usize| match costs.get((row, column)) {
        Some(cost) if cost.is_finite() && *cost < unassigned => *cost - unassigned,
        _ => 0.0,
    };
    let mut prices = Prices { row: vec![0.0; rows], column: vec![0.0; columns + rows] };
    let mut row_of: Vec<Option<usize>> = vec![None; columns + rows];
    for row in 0..rows {
        augment(&cost, row, &mut prices, &mut row_of);
    }
    let mut column_of = vec![None; rows];
    for (column, row) in row_of.iter().enumerate() {
        if let Some(row) = row {
            column_of[*row] = Some(column).filter(|c| *c < columns && cost(*row, *c) < 0.0);
        }
    }
    column_of
}

/// Dual variables: cost − row price − column price is non-negative, and zero for assigned pairs.
struct Prices {
    row: Vec<f64>,
    column: Vec<f64>,
}

/// Assigns a column to a free row, along the path of minimum reduced cost to a free column (Dijkstra).
fn augment(
    cost: &impl Fn(usize, usize) -> f64,
    start: usize,
    prices: &mut Prices,
    row_of: &mut [Option<usize>],
) {
    let count = row_of.len();
    let (mut distance, mut before) = (vec![f64::INFINITY; count], vec![None; count]);
    let mut done = vec![false; count];
    let (mut row, mut last, mut reached) = (start, None, 0.0);
    let free = loop {
        for column in (0..count).filter(|c| !done[*c]) {
            let through = reached + cost(row, column) - prices.row[row] - prices.column[column];
            if through < distance[column] {
                (distance[column], before[column]) = (through, last);
            }
        }
        // There are at least as many columns as rows, so one always remains.
        let Some(next) =
            (0..count).filter(|c| !done[*c]).min_by(|a, b| distance[*a].total_cmp(&distance[*b]))
        else {
            return;
        };
        reached = distance[next];
        match row_of[next] {
            None => break next,
            Some(occupant) => {
                done[next] = true;
                (row, last) = (occupant, Some(next));
            }
        }
    };
    for column in (0..count).filter(|c| done[*c]) {
        prices.column[column] += distance[column] - reached;
        if let Some(occupant) = row_of[column] {
            prices.row[occupant] += reached - distance[column];
        }
    }
    prices.row[start] += reached;
    augment_along(start, free, &before, row_of);
}

/// Moves every row on the path to the column after it.
fn augment_along(start: usize, free: usize, before: &[Option<usize>], row_of: &mut [Option<usize>]) {
    let mut column = free;
    while let Some(earlier) = before[column] {
        row_of[column] = row_of[earlier];
        column = earlier;
    }
    row_of[column] = Some(start);
}

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray::Array2;
    use proptest::prelude::*;

    /// Minimum of [`assignment`]'s sum by exhaustive search: the reference.
    fn by_trying_all(costs: ArrayView2<f64>, unassigned: f64) -> f64 {
        fn least(costs: ArrayView2<f64>, unassigned: f64, row: usize, used: &mut Vec<bool>) -> f64 {
            if row == costs.nrows() {
                return 0.0;
            }
            let mut best = unassigned + least(costs, unassigned, row + 1, used);
            for column in 0..costs.ncols() {
                if !used[column] && costs[(row, column)].is_finite() {
                    used[column] = true;
                    best = best.min(costs[(row, column)] + least(costs, unassigned, row + 1, used));
                    used[column] = false;
                }
            }
            best
        }
        least(costs, unassigned, 0, &mut vec![false; costs.ncols()])
    }

    fn total(costs: ArrayView2<f64>, unassigned: f64, chosen: &[Option<usize>]) -> f64 {
        chosen.iter().enumerate().map(|(row, c)| c.map_or(unassigned, |c| costs[(row, c)])).sum()
    }

    proptest! {
        #[test]
        fn the_total_is_that_of_trying_every_way(
            rows in 0_usize..6, columns in 0_usize..6, seed in prop::collection::vec(-4.0_f64..9.0, 36)
        ) {
            // Steps of a half produce ties; above 8 a pair is forbidden.
            let in_halves = |value: f64| (2.0 * value).round() / 2.0;
            let cost = |(r, c): (usize, usize)| Some(in_halves(seed[6 * r + c])).filter(|v| *v < 8.0);
            let costs = Array2::from_shape_fn((rows, columns), |at| cost(at).unwrap_or(f64::INFINITY));
            let chosen = assignment(costs.view(), 5.0);
            let columns_used: Vec<usize> = chosen.iter().flatten().copied().collect();
            let mut unique = columns_used.clone();
            unique.sort_unstable();
            unique.dedup();
            prop_assert_eq!(unique.len(), columns_used.len());
            let [asked, got] = [by_trying_all(costs.view(), 5.0), total(costs.view(), 5.0, &chosen)];
            // Sums of at most six numbers of at most 9 each.
            prop_assert!((asked - got).abs() < 1e-12, "asked {} got {}", asked, got);
        }
    }

    #[test]
    fn four_thousand_rows_beside_one_column_take_no_time() {
        // An algorithm cubic in the rows would take 10¹¹ steps, minutes.
        let costs = Array2::from_shape_fn((4000, 1), |(row, _)| if row == 1234 { 1.0 } else { 2.0 });
        let begun = std::time::Instant::now();
        let chosen = assignment(costs.view(), 5.0);
        assert_eq!((chosen[1234], chosen.iter().flatten().count()), (Some(0), 1));
        assert!(begun.elapsed().as_secs_f64() < 2.0, "{:?}", begun.elapsed());
    }

    #[test]
    fn a_row_stays_free_rather_than_pay_more_than_the_price() {
        let costs = ndarray::arr2(&[[1.0, 2.0], [0.5, 9.0], [f64::NAN, 3.0]]);
        assert_eq!(assignment(costs.view(), 5.0), [Some(1), Some(0), None]);
        assert_eq!(assignment(costs.view(), 1.5), [None, Some(0), None]);
    }
}
