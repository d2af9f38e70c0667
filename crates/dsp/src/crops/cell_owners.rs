//! Owners of the map's cells: a cell belongs to the object of the nearest located point.
//!
//! A crop of 24 m × 8 m/s also contains echoes of other vehicles, even stronger ones than the vehicle's own,
//! and a classifier trained on single vehicles takes them for parts of it. Distances are measured in cells
//! along both axes, so that a strong neighbour keeps its own sidelobes too.

use crate::spectrum::axes::Axes;
use artifact::points::PointsFrame;
use radar::doppler_ambiguity::folded;

/// Points of objects in and around a part of the map.
pub(crate) struct CellOwners {
    /// Points ordered by column, those of one column in their original order.
    peaks: Vec<LocatedPoint>,
    /// Number of rows, at which velocities wrap.
    rows: f64,
}

/// A located point of an object.
#[derive(Clone, Copy)]
struct LocatedPoint {
    row: f64,
    column: f64,
    /// Index among the points; the lowest wins among equally near ones.
    number: usize,
    object: u32,
}

impl CellOwners {
    /// Owners from the points of objects within a window of cells, `[first, last]` of rows and of columns;
    /// rows are not wrapped.
    pub(crate) fn within(axes: &Axes, points: &PointsFrame, [rows, columns]: [[i64; 2]; 2]) -> Self {
        let chirps = axes.rows as f64;
        let middle = 0.5 * (rows[0] + rows[1]) as f64;
        let half = 0.5 * (rows[1] - rows[0]) as f64;
        let located = points.points.iter().enumerate().filter_map(|(number, point)| {
            let velocity_mps = point.radial_velocity_mps;
            let column = axes.column_of(point.range_m, velocity_mps);
            Some(LocatedPoint { row: axes.row_at(velocity_mps), column, number, object: point.object? })
        });
        let is_near = |peak: &LocatedPoint| {
            folded(peak.row - middle, chirps).abs() <= half
                && (columns[0] as f64..=columns[1] as f64).contains(&peak.column)
        };
        Self::of_peaks(located.filter(is_near).collect(), chirps)
    }

    fn of_peaks(mut peaks: Vec<LocatedPoint>, rows: f64) -> Self {
        peaks.sort_by(|a, b| a.column.total_cmp(&b.column));
        Self { peaks, rows }
    }

    /// Object of the nearest point, the first of equally near ones; `None` without a point.
    ///
    /// The search proceeds outwards from the cell's own column, on either side only as far as a point may be
    /// nearer than the best so far: a frame of a thousand objects has thousands of points.
    pub(crate) fn of(&self, [row, column]: [i64; 2]) -> Option<u32> {
        let cell = [row as f64, column as f64];
        let (before, after) = self.peaks.split_at(self.peaks.partition_point(|peak| peak.column < cell[1]));
        let nearest = self.nearer(cell, None, after.iter());
        self.nearer(cell, nearest, before.iter().rev()).map(|(_, peak)| peak.object)
    }

    /// Nearest of the best so far and of points in order of column distance.
    fn nearer<'p>(
        &self,
        [row, column]: [f64; 2],
        mut best: Option<(f64, &'p LocatedPoint)>,
        outwards: impl Iterator<Item = &'p LocatedPoint>,
    ) -> Option<(f64, &'p LocatedPoint)> {
        for peak in outwards {
            let along = (peak.column - column).powi(2);
            if best.is_some_and(|(least, _)| along > least) {
                break;
            }
            let distance = folded(peak.row - row, self.rows).powi(2) + along;
            let is_nearer = |(least, first): (f64, &LocatedPoint)| {
                distance.total_cmp(&least).then(peak.number.cmp(&first.number)).is_lt()
            };
            if best.is_none_or(is_nearer) {
                best = Some((distance, peak));
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on a grid, with many equal distances, compared with an exhaustive search.
    #[test]
    fn the_nearest_point_is_that_of_a_search_through_all() {
        let mut state = 1_u64;
        let mut draw = |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % below
        };
        for count in [0, 1, 2, 7, 60] {
            let points: Vec<LocatedPoint> = (0..count)
                .map(|number| {
                    let half = |n: u64| 0.5 * n as f64;
                    let [row, column] = [half(draw(64)), half(draw(40))];
                    LocatedPoint { row, column, number, object: draw(5) as u32 }
                })
                .collect();
            let owners = CellOwners::of_peaks(points.clone(), 32.0);
            let cells = (-3..35).flat_map(|row| (-2..22).map(move |column| [row, column]));
            for [row, column] in cells {
                let distance = |p: &LocatedPoint| {
                    folded(p.row - row as f64, 32.0).powi(2) + (p.column - column as f64).powi(2)
                };
                let slow = points.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
                assert_eq!(owners.of([row, column]), slow.map(|p| p.object), "{count}: {row}, {column}");
            }
        }
    }
}
