//! Paths of a scene.

use crate::stepwise::opened_scene::OpenedScene;
use crate::stepwise::recorded::Recorded;
use artifact::paths::Paths;
use pipeline::chain::link::Scattering;
use pipeline::chain::stages::Stage;
use pipeline::host::call_off::CallOff;
use pipeline::host::failure::Failure;
use pipeline::host::progress::Work;

/// Traces the paths of every frame, as the command `paths` does.
///
/// # Errors
/// A body that cannot be traced, memory that does not suffice; called off between two frames.
pub fn paths(scene: &OpenedScene, call_off: &CallOff) -> Result<Recorded<Paths>, Failure> {
    let scene = &scene.by_paths();
    let (chain, count) = (scene.chain(), scene.header().frames);
    let (work, mut frames) = (Work::begin("frames"), Vec::new());
    for index in 0..count {
        call_off.check()?;
        work.at(index as usize, count as usize);
        let snapshot = scene::snapshot(scene.header(), index);
        let scattering = chain.scattering(&chain.plan(index), &snapshot)?.value;
        if let Scattering::Paths(frame) = chain.counted_through(scattering) {
            frames.push(frame);
        }
    }
    Ok(Recorded { from: scene.provenance(Stage::BartRcs), header: chain.paths_header(), frames })
}
