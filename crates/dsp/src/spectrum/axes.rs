//! Physical axes of a range-Doppler map.

use crate::spectrum::map_cells::{MapCells, RangeAxis};
use artifact::cube::CubeHeader;
use artifact::{Radar, Waveform};
use radar::beat::coupling_m;
use radar::doppler_ambiguity::{folded, wrapped_mps};

/// Rows and columns of the maps of one sub-frame in metres and metres per second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Axes {
    /// Number of Doppler cells.
    pub(crate) rows: usize,
    /// Number of range cells.
    pub(crate) columns: usize,
    /// Spacing of columns, m.
    pub(crate) range_cell_m: f64,
    /// Spacing of rows, m/s.
    pub(crate) velocity_cell_mps: f64,
    /// Maximum unambiguous velocity, half a span.
    pub(crate) velocity_max_mps: f64,
    /// Range at which the beat frequency aliases, m.
    pub(crate) range_max_m: f64,
    /// Neighbours of the cells.
    pub(crate) cells: MapCells,
    range_axis: RangeAxis,
    waveform: Waveform,
}

impl Axes {
    /// Axes of a sub-frame's radar.
    pub(crate) fn of(radar: &Radar) -> Self {
        let waveform = &radar.waveform;
        Self {
            rows: waveform.chirps as usize,
            columns: waveform.range_cells(),
            range_cell_m: waveform.range_resolution_m(),
            velocity_cell_mps: radar.velocity_resolution_mps(),
            velocity_max_mps: radar.velocity_max_mps(),
            range_max_m: waveform.range_max_m(),
            cells: MapCells::of(radar),
            range_axis: RangeAxis::of(radar),
            waveform: *waveform,
        }
    }

    /// Range at a fractional column, for an echo at rest.
    pub(crate) fn range_at(&self, column: f64) -> f64 {
        column * self.range_cell_m
    }

    /// Range of an echo with this velocity that appears at a fractional column, m, in [0, R_max).
    pub(crate) fn range_of(&self, column: f64, velocity_mps: f64) -> f64 {
        self.on_axis(self.range_at(column) - self.coupling_m(velocity_mps))
    }

    /// A range mapped to the axis, [0, R_max): wrapped on a circle; clamped to 0 from below on a segment.
    pub(crate) fn on_axis(&self, range_m: f64) -> f64 {
        match self.range_axis {
            // Just below 0 the remainder rounds to R_max, which is 0.
            RangeAxis::Circle => {
                Some(range_m.rem_euclid(self.range_max_m)).filter(|m| *m < self.range_max_m).unwrap_or(0.0)
            }
            RangeAxis::Segment => range_m.max(0.0),
        }
    }

    /// A range clamped to the ends of the axis.
    pub(crate) fn between_ends(&self, range_m: f64) -> f64 {
        match self.range_axis {
            RangeAxis::Circle => range_m.clamp(0.0, self.range_max_m.next_down()),
            RangeAxis::Segment => range_m.max(0.0),
        }
    }

    /// Difference `a_m` − `b_m`, the shorter way round if the axis is a circle.
    pub(crate) fn range_apart_m(&self, a_m: f64, b_m: f64) -> f64 {
        match self.range_axis {
            RangeAxis::Circle => folded(a_m - b_m, self.range_max_m),
            RangeAxis::Segment => a_m - b_m,
        }
    }

    /// Velocity at a fractional row.
    pub(crate) fn velocity_at(&self, row: f64) -> f64 {
        (row - (self.rows / 2) as f64) * self.velocity_cell_mps
    }

    /// Fractional row of a velocity, not wrapped.
    pub(crate) fn row_at(&self, velocity_mps: f64) -> f64 {
        velocity_mps / self.velocity_cell_mps + (self.rows / 2) as f64
    }

    /// Range–Doppler coupling of a velocity in these maps, m.
    pub(crate) fn coupling_m(&self, velocity_mps: f64) -> f64 {
        coupling_m(&self.waveform, velocity_mps)
    }

    /// Fractional column at which an echo with this range and velocity appears.
    pub(crate) fn column_of(&self, range_m: f64, velocity_mps: f64) -> f64 {
        self.column_at(self.on_axis(range_m + self.coupling_m(velocity_mps)))
    }

    /// Fractional column of a range, the round-trip delay times c/2; the sign of the chirp slope is removed
    /// when the map is made.
    pub(crate) fn column_at(&self, range_m: f64) -> f64 {
        range_m / self.range_cell_m
    }

    /// `velocity_mps` wrapped into one span of the axis, [−λ/4T, λ/4T).
    pub(crate) fn wrapped(&self, velocity_mps: f64) -> f64 {
        wrapped_mps(velocity_mps, 2.0 * self.velocity_max_mps)
    }

    /// `velocity_mps` moved by whole spans to be nearest to `near_mps`.
    pub(crate) fn unwrapped(&self, velocity_mps: f64, near_mps: f64) -> f64 {
        near_mps + self.wrapped(velocity_mps - near_mps)
    }
}

/// Range of every column, m: k·ΔR. The beat frequency aliases after the last column.
pub fn range_axis_m(header: &CubeHeader) -> Vec<f64> {
    let axes = Axes::of(&header.radar);
    (0..axes.columns).map(|column| axes.range_at(column as f64)).collect()
}

/// Radial velocity of every row, m/s, positive when the range grows; zero at row N/2.
pub fn velocity_axis_mps(header: &CubeHeader) -> Vec<f64> {
    let axes = Axes::of(&header.radar);
    (0..axes.rows).map(|row| axes.velocity_at(row as f64)).collect()
}
