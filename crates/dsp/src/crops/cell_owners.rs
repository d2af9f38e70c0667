//! Owners of the map's cells: a cell belongs to the object of the nearest located point.
//!
//! A crop of 24 m × 8 m/s holds what other vehicles left in the map as well, up to stronger than the vehicle
//! itself, and a classifier that learned from vehicles alone takes it for a part of this one. Distances are
//! counted in cells along both axes, so that a strong neighbour keeps its own side lobes too.

use crate::spectrum::axes::Axes;
use artifact::points::PointsFrame;

/// Points of objects in and around a part of the map, `[row, column]`.
pub(crate) struct CellOwners {
    peaks: Vec<([f64; 2], u32)>,
    /// Rows of the map: velocities wrap.
    rows: f64,
}

impl CellOwners {
    /// Owners by the points of objects within a window of cells, `[first, last]` of rows and of columns; rows
    /// are not wrapped.
    pub(crate) fn within(axes: &Axes, points: &PointsFrame, [rows, columns]: [[i64; 2]; 2]) -> Self {
        let chirps = axes.rows as f64;
        let middle = 0.5 * (rows[0] + rows[1]) as f64;
        let half = 0.5 * (rows[1] - rows[0]) as f64;
        let located = points.points.iter().filter_map(|point| {
            let velocity_mps = point.radial_velocity_mps;
            let column = axes.column_of(point.range_m, velocity_mps);
            Some(([axes.row_at(velocity_mps), column], point.object?))
        });
        let is_near = |([row, column], _): &([f64; 2], u32)| {
            wrapped(row - middle, chirps).abs() <= half
                && (columns[0] as f64..=columns[1] as f64).contains(column)
        };
        Self { peaks: located.filter(is_near).collect(), rows: chirps }
    }

    /// The object of the nearest point, the first of equally near ones; `None` without a point.
    pub(crate) fn of(&self, [row, column]: [i64; 2]) -> Option<u32> {
        let distance =
            |[r, c]: [f64; 2]| wrapped(r - row as f64, self.rows).powi(2) + (c - column as f64).powi(2);
        let distances = self.peaks.iter().map(|(at, object)| (distance(*at), *object));
        distances.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, object)| object)
    }
}

/// A difference of rows, by whole turns nearest to zero.
fn wrapped(rows: f64, turn: f64) -> f64 {
    rows - turn * (rows / turn).round()
}
