//! What clustering knows of a point.

use glam::DVec2;

/// What clustering knows of a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Member {
    /// From the array's centre, m.
    pub(crate) range_m: f64,
    /// m/s, in one span of the velocity axis.
    pub(crate) radial_velocity_mps: f64,
    /// Across the lanes, m.
    pub(crate) cross_m: f64,
    /// Standard error of that, by noise, m.
    pub(crate) cross_error_m: f64,
    /// Weight.
    pub(crate) power: f64,
    /// On the ground, from the radar.
    pub(crate) place_m: DVec2,
}
