//! Signature of one object in a map, cell by cell of range: the input of a classifier.

use serde::{Deserialize, Serialize};

/// An object's own echo along range, in the map's own cells: levels, places across and heights.
///
/// Nothing in it is truth. Levels are those of the radar equation for the power and the gain that the radar
/// says it has, so that neither range nor integration time changes them.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Signature {
    /// Range of the object, from the array's centre.
    pub range_m: f64,
    /// Radial velocity of the object, positive when the range grows.
    pub radial_velocity_mps: f64,
    /// Azimuth of the object, from the boresight towards the right.
    pub azimuth_rad: f64,
    /// Height of the radar over the road.
    pub radar_height_m: f64,
    /// Width of a beam along right and up, direction cosines; `None` where the array has no extent.
    pub beams: [Option<f64>; 2],
    /// Step from one cell of range to the next.
    pub cell_m: f64,
    /// Step from one cell of velocity to the next.
    pub velocity_cell_mps: f64,
    /// Cross section whose echo at the object's range is as strong as a beam's noise, dBsm.
    pub noise_dbsm: f64,
    /// Detected points of the object.
    pub points: u32,
    /// Ranges of the nearest and the farthest of the points.
    pub range_extent_m: [f64; 2],
    /// Share of the power of the object's peaks that ran between two bodies; `None` where the array cannot
    /// tell.
    pub ghost_share: Option<f64>,
    /// Range of the first of the cells: before the nearest point.
    pub first_range_m: f64,
    /// Cells of growing range.
    pub cells: Vec<SignatureCell>,
}

/// One range cell of a signature: the strongest of the object's own cells of velocity.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct SignatureCell {
    /// Beam power over the noise's, dB; 0 where the cell is another object's.
    pub level_db: f32,
    /// Place across the line of sight, to the right of the object's, m.
    pub cross_m: f32,
    /// Height over the road, m; `None` where the array has no rows.
    pub height_m: Option<f32>,
    /// Share of the channels' power that one direction explains.
    pub coherence: f32,
    /// Standard deviation of the power over velocity, m/s.
    pub velocity_spread_mps: f32,
}
