//! Position of an antenna relative to a body.

use glam::DVec3;

/// Position of an antenna, seen from the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standpoint {
    /// Azimuth from body x towards body y.
    pub azimuth_rad: f64,
    /// Elevation above the horizon.
    pub elevation_rad: f64,
    /// Distance to the origin; infinite for the far field.
    pub range_m: f64,
}

impl Standpoint {
    /// Unit vector from the origin.
    pub fn direction(&self) -> DVec3 {
        let (sin_el, cos_el) = self.elevation_rad.sin_cos();
        let (sin_az, cos_az) = self.azimuth_rad.sin_cos();
        DVec3::new(cos_el * cos_az, cos_el * sin_az, sin_el)
    }
}
