//! Physical axes of a range-Doppler map.

use artifact::cube::CubeHeader;
use artifact::{Radar, Waveform};
use radar::beat::coupling_m;
use radar::doppler_ambiguity::wrapped_mps;

/// Rows and columns of the maps of one sub-frame in metres and metres per second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Axes {
    /// Doppler cells.
    pub(crate) rows: usize,
    /// Range cells.
    pub(crate) columns: usize,
    /// Range from column to column, m.
    pub(crate) range_cell_m: f64,
    /// Velocity from row to row, m/s.
    pub(crate) velocity_cell_mps: f64,
    /// Half a span.
    pub(crate) velocity_max_mps: f64,
    /// Range at which the beat frequency folds, m.
    pub(crate) range_max_m: f64,
    waveform: Waveform,
}

impl Axes {
    /// Axes of a radar as it is in one sub-frame.
    pub(crate) fn of(radar: &Radar) -> Self {
        let waveform = &radar.waveform;
        Self {
            rows: waveform.chirps as usize,
            columns: waveform.range_cells(),
            range_cell_m: waveform.range_resolution_m(),
            velocity_cell_mps: radar.velocity_resolution_mps(),
            velocity_max_mps: radar.velocity_max_mps(),
            range_max_m: waveform.range_max_m(),
            waveform: *waveform,
        }
    }

    /// Range of a fractional column, as an echo at rest shows it.
    pub(crate) fn range_at(&self, column: f64) -> f64 {
        column * self.range_cell_m
    }

    /// Velocity at a fractional row.
    pub(crate) fn velocity_at(&self, row: f64) -> f64 {
        (row - (self.rows / 2) as f64) * self.velocity_cell_mps
    }

    /// Fractional row of a velocity, not wrapped.
    pub(crate) fn row_at(&self, velocity_mps: f64) -> f64 {
        velocity_mps / self.velocity_cell_mps + (self.rows / 2) as f64
    }

    /// Range–Doppler coupling of a velocity on these maps, m.
    pub(crate) fn coupling_m(&self, velocity_mps: f64) -> f64 {
        coupling_m(&self.waveform, velocity_mps)
    }

    /// Range cells per second of round-trip delay times c/2; the sign of the slope is undone when the map is
    /// made.
    pub(crate) fn column_at(&self, range_m: f64) -> f64 {
        range_m / self.range_cell_m
    }

    /// `velocity_mps` brought into one span of the axis, [−λ/4T, λ/4T).
    pub(crate) fn wrapped(&self, velocity_mps: f64) -> f64 {
        wrapped_mps(velocity_mps, 2.0 * self.velocity_max_mps)
    }

    /// `velocity_mps` moved by whole spans until it is nearest to `near_mps`.
    pub(crate) fn unwrapped(&self, velocity_mps: f64, near_mps: f64) -> f64 {
        near_mps + self.wrapped(velocity_mps - near_mps)
    }
}

/// Range of every column, m: k·ΔR. The beat frequency folds at the last column.
pub fn range_axis_m(header: &CubeHeader) -> Vec<f64> {
    let axes = Axes::of(&header.radar);
    (0..axes.columns).map(|column| axes.range_at(column as f64)).collect()
}

/// Radial velocity of every row, m/s, positive when the range grows; zero at row N/2.
pub fn velocity_axis_mps(header: &CubeHeader) -> Vec<f64> {
    let axes = Axes::of(&header.radar);
    (0..axes.rows).map(|row| axes.velocity_at(row as f64)).collect()
}
