//! Radar cubes of a scene.

use crate::stepwise::opened_scene::OpenedScene;
use crate::stepwise::paths_of_scene;
use crate::stepwise::recorded::Recorded;
use artifact::cube::{Cube, CubeFrame};
use artifact::paths::Paths;
use pipeline::chain::link::{Chain, Scattering};
use pipeline::chain::stages::Stage;
use pipeline::host::call_off::CallOff;
use pipeline::host::failure::Failure;
use pipeline::host::progress::Work;

/// Makes the cubes of every frame, as the command `echo` does: of paths or, where the scene asks for them, of
/// tables.
///
/// # Errors
/// Those of tracing; an echo that cannot be summed; called off between two frames.
pub fn echoes(scene: &OpenedScene, call_off: &CallOff) -> Result<Recorded<Cube>, Failure> {
    let (chain, count) = (scene.chain(), scene.header().frames);
    let (work, mut frames) = (Work::begin("frames"), Vec::new());
    for index in 0..count {
        call_off.check()?;
        work.at(index as usize, count as usize);
        let snapshot = scene::snapshot(scene.header(), index);
        let scattering = chain.scattering(&chain.plan(index), &snapshot)?.value;
        frames.push(chain.synthesize(&snapshot, &scattering)?);
    }
    Ok(recorded(scene, &chain, frames))
}

/// Makes the cubes of paths that were traced before, as `echo --paths` does.
///
/// # Errors
/// Paths of another sweep, radar's place, bodies or times than the scene's; an echo that cannot be summed;
/// called off between two frames.
pub fn echoes_of_paths(
    scene: &OpenedScene,
    paths: &Recorded<Paths>,
    call_off: &CallOff,
) -> Result<Recorded<Cube>, Failure> {
    let scene = &scene.by_paths();
    let chain = scene.chain();
    paths_of_scene::check_header(&chain, scene.files(), &paths.header, &paths.from)?;
    let (work, mut frames) = (Work::begin("frames"), Vec::new());
    for (done, frame) in paths.frames.iter().enumerate() {
        call_off.check()?;
        work.at(done, paths.frames.len());
        let snapshot = paths_of_scene::check_frame(scene.header(), frame)?;
        frames.push(chain.synthesize(&snapshot, &Scattering::Paths(frame.clone()))?);
    }
    Ok(recorded(scene, &chain, frames))
}

fn recorded(scene: &OpenedScene, chain: &Chain, frames: Vec<CubeFrame>) -> Recorded<Cube> {
    Recorded { from: scene.provenance(Stage::FmcwEcho), header: chain.cube_header.clone(), frames }
}
