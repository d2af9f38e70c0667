//! An object that tests share.

use artifact::points::{Height, Object};

/// An object at rest at a place.
pub(crate) fn object_at([x_m, y_m]: [f64; 2]) -> Object {
    Object {
        range_m: y_m,
        radial_velocity_mps: 0.0,
        velocity_resolved: false,
        azimuth_rad: 0.0,
        position_m: [x_m, y_m, 0.75],
        lane: None,
        snr_db: 20.0,
        points: 1,
        range_extent_m: [y_m; 2],
        velocity_extent_mps: [0.0; 2],
        ghost_share: None,
        stationary: None,
        height: Height::Assumed,
    }
}
