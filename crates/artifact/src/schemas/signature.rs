//! Signature of one object in a map, one range cell after another: the input of a classifier.

use serde::{Deserialize, Serialize};

/// An object's own echo along range, in the map's own cells: levels, cross-range positions and heights.
///
/// It contains no truth. Levels follow from the radar equation with the power and gain that the radar
/// specifies, so that they depend neither on range nor on integration time.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Signature {
    /// Range of the object from the array's centre.
    pub range_m: f64,
    /// Radial velocity of the object, positive when the range grows.
    pub radial_velocity_mps: f64,
    /// Azimuth of the object from the boresight towards the right.
    pub azimuth_rad: f64,
    /// Height of the radar above the road.
    pub radar_height_m: f64,
    /// Beamwidths along right and up, direction cosines; `None` where the array has no extent.
    pub beams: [Option<f64>; 2],
    /// Spacing of range cells.
    pub cell_m: f64,
    /// Spacing of velocity cells.
    pub velocity_cell_mps: f64,
    /// Cross section whose echo at the object's range equals a beam's noise, dBsm.
    pub noise_dbsm: f64,
    /// Detected points of the object.
    pub points: u32,
    /// Ranges of the nearest and the farthest of the points.
    pub range_extent_m: [f64; 2],
    /// Share of the power of the object's peaks that travelled between two bodies; `None` where the array
    /// cannot resolve it.
    pub ghost_share: Option<f64>,
    /// Range of the first cell, which lies before the nearest point.
    pub first_range_m: f64,
    /// Cells in order of increasing range.
    pub cells: Vec<SignatureCell>,
}

/// One range cell of a signature: the strongest of the object's own velocity cells.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct SignatureCell {
    /// Beam power over noise power, dB; 0 where the cell belongs to another object.
    pub level_db: f32,
    /// Position across the line of sight, relative to the object's, positive to the right, m.
    pub cross_m: f32,
    /// Height above the road, m; `None` where the array has no elevation rows.
    pub height_m: Option<f32>,
    /// Share of the channels' power explained by a single direction.
    pub coherence: f32,
    /// Standard deviation of the power over velocity, m/s.
    pub velocity_spread_mps: f32,
}
