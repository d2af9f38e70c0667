//! Objects and bodies that tests share.

use crate::ground_outline::GroundOutline;
use crate::truth::Truth;
use artifact::points::{Height, Object};
use artifact::scene::{Mesh, Pose, Role};
use glam::DVec3;

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

/// A body of this length that comes down its lane, its middle at a place.
pub(crate) fn body(length_m: f64, [x_m, y_m]: [f64; 2]) -> Truth {
    let yaw_rad = -std::f64::consts::FRAC_PI_2;
    let pose = Pose {
        position_m: [x_m, y_m, 0.0],
        yaw_rad,
        yaw_radps: 0.0,
        velocity_mps: [0.0; 3],
        acceleration_mps2: [0.0; 3],
    };
    let vertices_m = vec![[-0.5 * length_m, -1.0, 0.0], [0.5 * length_m, 1.0, 1.5]];
    Truth {
        role: Role::Target,
        position_m: DVec3::from(pose.position_m),
        outline: GroundOutline::of_mesh(&Mesh { vertices_m, ..Mesh::default() }, &pose),
        range_m: y_m,
        velocity_mps: DVec3::ZERO,
        radial_velocity_mps: 0.0,
        lane: None,
        nearest_range_m: None,
        echo: None,
        returns_echo: true,
    }
}
