//! Radar cubes of a scene.

use crate::stepwise::complete_artifact::CompleteArtifact;
use crate::stepwise::opened_scene::OpenedScene;
use crate::stepwise::paths_of_scene;
use artifact::cube::{Cube, CubeFrame};
use artifact::paths::Paths;
use pipeline::chain::frame_result::Scattering;
use pipeline::chain::frames::each_frame;
use pipeline::chain::link::Chain;
use pipeline::chain::plan::FramePlan;
use pipeline::chain::stages::Stage;
use pipeline::host::cancellation::Cancellation;
use pipeline::host::failure::Failure;
use pipeline::host::progress::{FrameStage, Work};

/// Makes the cubes of every frame, as the command `echo` does: from paths or, if the scene asks for them,
/// from tables.
///
/// # Errors
/// Those of tracing; an echo that cannot be summed; the call was cancelled between two frames.
pub fn echoes(scene: &OpenedScene, cancellation: &Cancellation) -> Result<CompleteArtifact<Cube>, Failure> {
    let (chain, mut frames) = (scene.chain(), Vec::new());
    let echo = |plan: &FramePlan| {
        let scattering = chain.scattering(plan)?;
        chain.synthesize(&scene::snapshot(scene.header(), plan.index), &scattering)
    };
    let keep = |frame| {
        frames.push(frame);
        Ok(())
    };
    let stages = [FrameStage::Scattering, FrameStage::Echo];
    each_frame(&chain, (&chain.plans(), &stages), cancellation, echo, keep)?;
    Ok(recorded(scene, &chain, frames))
}

/// Makes the cubes of previously traced paths, as `echo --paths` does.
///
/// # Errors
/// Paths whose sweep, radar position, bodies or times differ from the scene's; an echo that cannot be summed;
/// the call was cancelled between two frames.
pub fn echoes_of_paths(
    scene: &OpenedScene,
    paths: &CompleteArtifact<Paths>,
    cancellation: &Cancellation,
) -> Result<CompleteArtifact<Cube>, Failure> {
    let scene = &scene.by_paths();
    let chain = scene.chain();
    paths_of_scene::check_header(&chain, (scene.files(), scene.said()), &paths.header, &paths.from)?;
    let (work, mut frames) = (Work::in_stages("frames", &[FrameStage::Echo]), Vec::new());
    for (done, frame) in paths.frames.iter().enumerate() {
        cancellation.check()?;
        work.at(done, paths.frames.len());
        let snapshot = paths_of_scene::check_frame(scene.header(), frame)?;
        frames.push(chain.synthesize(&snapshot, &Scattering::Paths(frame.clone()))?);
    }
    Ok(recorded(scene, &chain, frames))
}

fn recorded(scene: &OpenedScene, chain: &Chain, frames: Vec<CubeFrame>) -> CompleteArtifact<Cube> {
    CompleteArtifact { from: scene.provenance(Stage::FmcwEcho), header: chain.cube_header().clone(), frames }
}
