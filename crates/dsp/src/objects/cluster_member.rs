//! Properties of a point that clustering knows.

use glam::DVec2;

/// Properties of a point that clustering knows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Member {
    /// Range from the array's centre, m.
    pub(crate) range_m: f64,
    /// Radial velocity, m/s, in one span of the velocity axis.
    pub(crate) radial_velocity_mps: f64,
    /// Place across the lanes, m.
    pub(crate) cross_m: f64,
    /// Standard error of that, by noise, m.
    pub(crate) cross_error_m: f64,
    /// Weight.
    pub(crate) power: f64,
    /// Place on the ground, from the radar, m.
    pub(crate) place_m: DVec2,
}
