//! Properties of a point used by clustering.

use glam::DVec2;

/// Properties of a point used by clustering.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ClusterPoint {
    /// Range from the array's centre, m.
    pub(crate) range_m: f64,
    /// Radial velocity, m/s, in one span of the velocity axis.
    pub(crate) radial_velocity_mps: f64,
    /// Position across the lanes, m.
    pub(crate) cross_m: f64,
    /// Standard error of `cross_m` due to noise, m.
    pub(crate) cross_error_m: f64,
    /// Power, the point's weight.
    pub(crate) power: f64,
    /// Position on the ground relative to the radar, m.
    pub(crate) place_m: DVec2,
}
