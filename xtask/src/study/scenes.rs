//! Scenes of the studies: a scene file's radar and settings, bodies in its lanes, and the chain to points.

use artifact::cube::{CubeFrame, CubeHeader, SampleUnit};
use artifact::paths::PathsFrame;
use artifact::points::PointsFrame;
use artifact::rcs::RcsFrame;
use artifact::rdm::RdmFrame;
use artifact::scene::{Mesh, Pose, Role, SceneFrame, SceneHeader, Target, TargetKind};
use scene::ReadOptions;
use std::f64::consts::FRAC_PI_2;
use wayside::host::failure::Failure;

/// A scene from the text of a scene file; without targets unless they are in it.
pub(crate) fn scene_of(words: &str) -> Result<SceneHeader, Failure> {
    let folder = tempfile::tempdir().map_err(|e| Failure::System(format!("no temporary folder: {e}")))?;
    let file = folder.path().join("study.toml");
    std::fs::write(&file, format!("name = \"study\"\n{words}"))
        .map_err(|e| Failure::system(&file, "write", e))?;
    // The folder's name differs in every run, so it is removed from text that a page quotes.
    let named = |e: scene::SceneErrors| {
        Failure::refused(e.to_string().replace(&format!("{}/", folder.path().display()), ""))
    };
    scene::read(&file, &ReadOptions::whole()).map_err(named)
}

/// The scene with one more body; its front faces −y, the radar, like that of an approaching vehicle.
pub(super) fn with_body(
    mut header: SceneHeader,
    body: &Mesh,
    position_m: [f64; 3],
    velocity_mps: [f64; 3],
) -> SceneHeader {
    let mesh = header.meshes.len() as u32;
    header.meshes.push(body.clone());
    let kind = TargetKind::Mesh { class: None, model: body.name.clone(), mesh };
    let start =
        Pose { position_m, yaw_rad: -FRAC_PI_2, yaw_radps: 0.0, velocity_mps, acceleration_mps2: [0.0; 3] };
    header.targets.push(Target { id: format!("body-{mesh}"), role: Role::Target, kind, start });
    header
}

/// The scene with one more point target.
pub(super) fn with_point(
    mut header: SceneHeader,
    rcs_m2: f64,
    position_m: [f64; 3],
    velocity_mps: [f64; 3],
) -> SceneHeader {
    let id = format!("point-{}", header.targets.len());
    let start = Pose { position_m, yaw_rad: 0.0, yaw_radps: 0.0, velocity_mps, acceleration_mps2: [0.0; 3] };
    header.targets.push(Target {
        id,
        role: Role::Target,
        kind: TargetKind::Point { rcs_m2, wheel: None },
        start,
    });
    header
}

/// The first frame of a scene.
pub(super) fn frame_of(header: &SceneHeader) -> SceneFrame {
    scene::snapshot(header, 0)
}

pub(super) fn paths_of(header: &SceneHeader) -> Result<PathsFrame, Failure> {
    paths_at(header, &frame_of(header))
}

pub(super) fn paths_at(header: &SceneHeader, frame: &SceneFrame) -> Result<PathsFrame, Failure> {
    let tracer = bart_rcs::Tracer::new(header).map_err(Failure::refused)?;
    tracer.all_paths(header, frame, &bart_rcs::FrameContext::ALONE).map_err(Failure::refused)
}

/// The paper's σ_f for a frame.
pub(super) fn tables_at(header: &SceneHeader, frame: &SceneFrame) -> Result<RcsFrame, Failure> {
    let tracer = bart_rcs::Tracer::new(header).map_err(Failure::refused)?;
    tracer.tables(header, frame, &bart_rcs::NoProgress).map_err(Failure::refused)
}

pub(crate) fn cube_header(header: &SceneHeader) -> CubeHeader {
    CubeHeader {
        radar: header.radar.clone(),
        noise: header.noise,
        dsp: header.dsp.clone(),
        unit: SampleUnit::RootWatts,
    }
}

pub(super) fn cube_of(header: &SceneHeader, paths: &PathsFrame) -> Result<CubeFrame, Failure> {
    synthesizer(header, header.seed)?.frame(paths, &|_| ()).map_err(Failure::refused)
}

/// Synthesizer of a scene's cubes, without the ground.
pub(super) fn synthesizer(header: &SceneHeader, seed: u64) -> Result<fmcw_echo::Synthesizer, Failure> {
    let accuracy = fmcw_echo::sum_accuracy(header.fidelity.accuracy);
    fmcw_echo::Synthesizer::new(&cube_header(header), seed, accuracy, vec![]).map_err(Failure::refused)
}

/// Map and points of a radar for the first frame.
pub(super) struct DetectionResult {
    pub(super) map: RdmFrame,
    pub(super) points: PointsFrame,
}

pub(super) fn detect(header: &SceneHeader) -> Result<DetectionResult, Failure> {
    let cube = cube_of(header, &paths_of(header)?)?;
    let receiver = dsp::Receiver::new(&cube_header(header)).map_err(Failure::refused)?;
    let map = receiver.range_doppler(&cube).map_err(Failure::refused)?;
    let points = receiver.detect(&map).map_err(Failure::refused)?;
    Ok(DetectionResult { map, points })
}
