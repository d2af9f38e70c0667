//! Positions in world axes from range and direction cosines.

use crate::direction::angle::{Direction, VirtualArray};
use artifact::points::Height;
use glam::DVec3;

/// Position of a point in world axes, with its angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WorldPosition {
    /// World metres.
    pub(crate) position_m: DVec3,
    /// Azimuth from +y towards +x.
    pub(crate) azimuth_rad: f64,
    /// Elevation above the horizon.
    pub(crate) elevation_rad: f64,
    /// Basis of the height.
    pub(crate) height: Height,
}

/// Position of a point at `range_m` from the array's centre.
///
/// With elevation rows both direction cosines are measured. Without, range and the one cosine u leave a
/// circle (the sphere cut by the cone around the row); the assumed height h selects the point in front of the
/// array ([`at_height`]). A circle that stays above it, R²(1 − u²) < (h − z_radar)², has no such point: then
/// the point is at the array's own height, and its azimuth is that of the boresight plus the cone angle asin
/// u.
pub(crate) fn world_position(array: &VirtualArray, direction: Direction, range_m: f64) -> WorldPosition {
    let [right, up, ahead] = array.axes();
    let [u, w, out_of_plane] = direction.cosines();
    let (from_radar, height) = match direction.up {
        Some(_) => (range_m * (u * right + w * up + out_of_plane * ahead), Height::Measured),
        None => match at_height(range_m, u, array.assumed_height_m() - array.position_m().z) {
            Some(in_row) => (of_row(right, in_row), Height::Assumed),
            None => (of_row(right, [range_m * u, range_m * across(u), 0.0]), Height::None),
        },
    };
    WorldPosition {
        position_m: array.position_m() + from_radar,
        azimuth_rad: from_radar.x.atan2(from_radar.y),
        elevation_rad: from_radar.z.atan2(from_radar.x.hypot(from_radar.y)),
        height,
    }
}

/// Position R·u along the row, √(R² − (R·u)² − h²) ahead, h up; `None` if the range is less than the height.
fn at_height(range_m: f64, u: f64, up_m: f64) -> Option<[f64; 3]> {
    let across_m = range_m * across(u);
    let ahead2_m2 = (across_m - up_m.abs()) * (across_m + up_m.abs());
    (ahead2_m2 >= 0.0).then(|| [range_m * u, ahead2_m2.sqrt(), up_m])
}

/// Direction cosine across the row, √(1 − u²).
fn across(u: f64) -> f64 {
    (1.0 - u * u).max(0.0).sqrt()
}

/// World axes from along, ahead and up: the row is horizontal, and so is the direction across it.
fn of_row(right: DVec3, [along_m, ahead_m, up_m]: [f64; 3]) -> DVec3 {
    along_m * right + ahead_m * DVec3::Z.cross(right) + up_m * DVec3::Z
}
