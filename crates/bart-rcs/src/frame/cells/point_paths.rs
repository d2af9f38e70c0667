//! Paths of point targets, each exact.

use artifact::paths::{Curve, Path, Rim};
use artifact::scene::{Pose, SceneFrame, SceneHeader, Target, TargetKind, Wheel};
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Paths of the point targets of a frame, in their order.
pub(crate) fn point_paths(header: &SceneHeader, frame: &SceneFrame) -> Vec<Path> {
    let targets = (0..).zip(header.targets.iter().zip(&frame.poses));
    let of = |(target, (kind, pose)): (u32, (&Target, &Pose))| {
        let TargetKind::Point { rcs_m2, wheel } = kind.kind else { return None };
        let root = Complex64::from(rcs_m2.sqrt());
        let amplitude_m = [[root, Complex64::ZERO], [Complex64::ZERO, root]];
        let curve = Curve {
            apparent_tx_mps2: pose.acceleration_mps2,
            apparent_rx_mps2: pose.acceleration_mps2,
            rim: wheel.map(|wheel| rim(&wheel, &kind.start, pose)),
            ..Curve::default()
        };
        Some(Path { target, curve, ..Path::of_point(pose.position_m, pose.velocity_mps, amplitude_m) })
    };
    targets.filter_map(of).collect()
}

/// Rim after rolling since the scene's start.
fn rim(wheel: &Wheel, start: &Pose, pose: &Pose) -> Rim {
    let (sin, cos) = pose.yaw_rad.sin_cos();
    let forward = DVec3::new(cos, sin, 0.0);
    let way_m = (DVec3::from_array(pose.position_m) - DVec3::from_array(start.position_m)).dot(forward);
    let angle_rad = (wheel.angle_rad - way_m / wheel.radius_m).rem_euclid(TAU);
    Rim { radius_m: wheel.radius_m, forward: forward.to_array(), angle_rad }
}
