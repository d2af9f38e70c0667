//! Motion: constant acceleration and yaw rate of targets, recorded poses of traffic.

use artifact::scene::{Role, SceneFrame, SceneHeader, Target, Vehicle, VehiclePose};
use radar::motion::pose_after;

/// Poses at the first sample of frame `frame_index`: the scene's targets, then the vehicles in view.
pub fn snapshot(scene: &SceneHeader, frame_index: u32) -> SceneFrame {
    let time_s = scene.frame_time_s(frame_index);
    let targets = scene.targets.iter().map(|target| pose_after(&target.start, time_s));
    let poses = targets.chain(placed(scene, frame_index).map(|placed| placed.pose)).collect();
    SceneFrame { index: frame_index, time_s, poses }
}

/// Vehicles in view of a frame, at its first sample; none without traffic. A recording has a pose for each
/// cycle of sub-frames.
fn placed(scene: &SceneHeader, frame_index: u32) -> impl Iterator<Item = VehiclePose> {
    let cycle = (frame_index / scene.radar.schedule.sub_frames()) as usize;
    let later_s = scene.radar.sub_frame_start_s(frame_index);
    let recorded = scene.traffic.iter().flat_map(move |traffic| traffic.frames.get(cycle)).flatten();
    recorded.map(move |placed| VehiclePose { pose: pose_after(&placed.pose, later_s), ..*placed })
}

/// The vehicles in view of a frame, in the order of the snapshot's poses, after those of the targets.
pub fn vehicles_in_view(scene: &SceneHeader, frame_index: u32) -> Vec<&Vehicle> {
    let vehicles = scene.traffic.as_ref().map_or(&[][..], |traffic| &traffic.vehicles);
    placed(scene, frame_index).filter_map(|placed| vehicles.get(placed.vehicle as usize)).collect()
}

/// Index of each of a snapshot's bodies among all bodies of the scene: targets first, then every vehicle that
/// is in view in some frame.
pub fn bodies_in_view(scene: &SceneHeader, frame_index: u32) -> Vec<u32> {
    let targets = scene.targets.len() as u32;
    (0..targets).chain(placed(scene, frame_index).map(|placed| targets + placed.vehicle)).collect()
}

/// The scene of one frame alone: vehicles in view are ordinary targets, in the order of the snapshot's poses,
/// with their pose in that frame as `start`. The cost of a frame then depends on the vehicles in view, not on
/// the length of the recording.
pub fn frame_view(scene: &SceneHeader, frame_index: u32) -> SceneHeader {
    let in_view = vehicles_in_view(scene, frame_index).into_iter().zip(placed(scene, frame_index));
    let in_view = in_view.map(|(vehicle, placed)| Target {
        id: vehicle.id.clone(),
        role: Role::Target,
        kind: vehicle.kind.clone(),
        start: placed.pose,
    });
    SceneHeader {
        name: scene.name.clone(),
        seed: scene.seed,
        frames: scene.frames,
        frame_interval_s: scene.frame_interval_s,
        radar: scene.radar.clone(),
        noise: scene.noise,
        dsp: scene.dsp.clone(),
        fidelity: scene.fidelity,
        intersection: scene.intersection,
        materials: scene.materials.clone(),
        road: scene.road.clone(),
        backscatter: scene.backscatter,
        meshes: scene.meshes.clone(),
        targets: scene.targets.iter().cloned().chain(in_view).collect(),
        traffic: None,
    }
}
