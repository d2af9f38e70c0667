//! Places in world axes, found from range and direction cosines.

use crate::direction::angle::{Direction, VirtualArray};
use glam::DVec3;

/// Place of a point in world axes, with its angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    /// World metres.
    pub(crate) position_m: DVec3,
    /// Azimuth from +y towards +x.
    pub(crate) azimuth_rad: f64,
    /// Above the horizon.
    pub(crate) elevation_rad: f64,
}

/// Place of a point at `range_m` from the array's centre.
///
/// With elevation rows both direction cosines are measured. Without, range and the one cosine u leave a
/// circle (the sphere cut by the cone around the row); the assumed height picks the point in front of the
/// array: along the row R·u, up h − z_radar, ahead √(R² − (R·u)² − (h − z_radar)²), 0 where the point is
/// nearer than its height.
pub(crate) fn place(array: &VirtualArray, direction: Direction, range_m: f64) -> Place {
    let [right, up, ahead] = array.axes();
    let u = direction.right;
    let from_radar = match direction.up {
        Some(w) => range_m * (u * right + w * up + (1.0 - u * u - w * w).max(0.0).sqrt() * ahead),
        None => {
            let along_m = range_m * u;
            let up_m = array.assumed_height_m() - array.position_m().z;
            let ahead_m = (range_m * range_m - along_m * along_m - up_m * up_m).max(0.0).sqrt();
            // The row is horizontal, so is the direction across it.
            along_m * right + ahead_m * DVec3::Z.cross(right) + up_m * DVec3::Z
        }
    };
    Place {
        position_m: array.position_m() + from_radar,
        azimuth_rad: from_radar.x.atan2(from_radar.y),
        elevation_rad: from_radar.z.atan2(from_radar.x.hypot(from_radar.y)),
    }
}
