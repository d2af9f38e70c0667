//! Motion: constant velocity and yaw; points may be accelerated.

use artifact::scene::{Pose, SceneFrame, SceneHeader, TargetKind};

/// Poses at the first sample of frame `frame_index`, in the order of the scene's targets.
pub fn snapshot(scene: &SceneHeader, frame_index: u32) -> SceneFrame {
    let time_s = scene.frame_time_s(frame_index);
    let poses = scene.targets.iter().map(|target| moved(&target.kind, &target.start, time_s)).collect();
    SceneFrame { index: frame_index, time_s, poses }
}

/// The pose of a target of some kind `elapsed_s` later; its velocity too is that of the moment.
pub fn moved(kind: &TargetKind, pose: &Pose, elapsed_s: f64) -> Pose {
    let pose = pose_after(pose, elapsed_s);
    let TargetKind::Point { acceleration_mps2, .. } = kind else { return pose };
    let gained_mps = acceleration_mps2.map(|acceleration_mps2| acceleration_mps2 * elapsed_s);
    Pose {
        position_m: [0, 1, 2].map(|axis| pose.position_m[axis] + 0.5 * gained_mps[axis] * elapsed_s),
        velocity_mps: [0, 1, 2].map(|axis| pose.velocity_mps[axis] + gained_mps[axis]),
        ..pose
    }
}

/// The pose `elapsed_s` later (or earlier, where negative), rounded once: to half a unit in the last place.
pub fn pose_after(pose: &Pose, elapsed_s: f64) -> Pose {
    // Fused: after an hour at 30 m/s the product alone would round by 1.5e-11 m, 4e-9 of a wavelength. It costs nothing.
    let along = |axis: usize| pose.velocity_mps[axis].mul_add(elapsed_s, pose.position_m[axis]);
    Pose { position_m: [along(0), along(1), along(2)], ..*pose }
}
