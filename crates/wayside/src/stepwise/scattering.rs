//! Paths of a scene.

use crate::stepwise::complete_artifact::CompleteArtifact;
use crate::stepwise::opened_scene::OpenedScene;
use artifact::paths::Paths;
use pipeline::chain::frame_result::Scattering;
use pipeline::chain::frames::each_frame;
use pipeline::chain::link::artifact_headers;
use pipeline::chain::stages::Stage;
use pipeline::host::cancellation::Cancellation;
use pipeline::host::failure::Failure;
use pipeline::host::progress::FrameStage;

/// Traces the paths of every frame, as the command `paths` does.
///
/// # Errors
/// A body that cannot be traced, insufficient memory; the call was cancelled between two frames.
pub fn paths(scene: &OpenedScene, cancellation: &Cancellation) -> Result<CompleteArtifact<Paths>, Failure> {
    let scene = &scene.by_paths();
    let (chain, mut frames) = (scene.chain(), Vec::new());
    let keep = |scattering: Scattering| {
        if let Scattering::Paths(frame) = scattering.numbered_as_in(chain.header) {
            frames.push(frame);
        }
        Ok(())
    };
    let stages = [FrameStage::Scattering];
    each_frame(&chain, (&chain.plans(), &stages), cancellation, |plan| chain.scattering(plan), keep)?;
    Ok(CompleteArtifact {
        from: scene.provenance(Stage::BartRcs),
        header: artifact_headers::paths_header(chain.header),
        frames,
    })
}
