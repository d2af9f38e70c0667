//! Motion: constant velocity and yaw.

use artifact::scene::{Pose, SceneFrame, SceneHeader};

/// Poses at the first sample of frame `frame_index`, in the order of the scene's targets.
pub fn snapshot(scene: &SceneHeader, frame_index: u32) -> SceneFrame {
    let time_s = scene.frame_time_s(frame_index);
    let poses = scene.targets.iter().map(|target| pose_after(&target.start, time_s)).collect();
    SceneFrame { index: frame_index, time_s, poses }
}

/// The pose `elapsed_s` later (or earlier, where negative), rounded once: to half a unit in the last place.
pub fn pose_after(pose: &Pose, elapsed_s: f64) -> Pose {
    // Fused: after an hour at 30 m/s the product alone would round by 1.5e-11 m, 4e-9 of a wavelength. It costs nothing.
    let along = |axis: usize| pose.velocity_mps[axis].mul_add(elapsed_s, pose.position_m[axis]);
    Pose { position_m: [along(0), along(1), along(2)], ..*pose }
}
