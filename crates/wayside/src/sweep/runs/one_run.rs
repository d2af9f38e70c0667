//! One run: a design in a situation through the whole chain to its summary, without files and pictures.

use crate::chain::cache::Cache;
use crate::chain::cycles::resolved;
use crate::chain::link::Chain;
use crate::chain::loaded_model::LoadedModel;
use crate::chain::loading;
use crate::chain::stages::Stage;
use crate::host::failure::Failure;
use crate::host::memory::Allowance;
use crate::outcome::frame_truth::frame_truth;
use crate::outcome::summary::{FrameSummary, Summary};
use crate::outcome::tracking::Tracking;
use artifact::scene::SceneHeader;
use scene::{Change, Meshes, ReadOptions};
use std::path::Path;

/// Means that all runs of a study share.
pub(crate) struct Means<'a> {
    pub(crate) cache: Option<&'a Cache>,
    pub(crate) model: &'a LoadedModel,
    pub(crate) memory: Allowance,
    /// Runs that share the memory.
    pub(crate) at_once: usize,
}

/// The scene of a study, changed, with its models and its seed.
pub(crate) fn read(
    scene: &Path,
    radar: Option<&str>,
    changes: &[Change],
    seed: u64,
) -> Result<SceneHeader, Failure> {
    let options = ReadOptions { model: None, radar: radar.map(str::to_owned), meshes: Meshes::Whole };
    let header = scene::read_changed(scene, changes, &options).map_err(loading::of_scene)?;
    Ok(SceneHeader { seed, ..header })
}

/// Summary of all frames of a scene. Of the cache only scattering is asked and told: what comes behind it is
/// quickly made again, and fills a disk.
pub(crate) fn summary(header: &SceneHeader, means: &Means) -> Result<Summary, Failure> {
    let chain = Chain::of(header, means.cache, Some(means.model), means.memory).keeping(Stage::BartRcs);
    chain.share_memory(means.at_once);
    let mut tracking = Tracking::of(&chain)?;
    let (mut frames, mut cycle) = (Vec::new(), Vec::new());
    for index in 0..header.frames {
        cycle.push(chain.frame(&chain.plan(index))?);
        if cycle.len() < header.radar.schedule.sub_frames() as usize {
            continue;
        }
        for frame in resolved(&chain, std::mem::take(&mut cycle))? {
            let truth = frame_truth(&chain, &frame)?;
            let (_, tracks) = tracking.follow(&frame, &truth)?;
            frames.push(FrameSummary::of(&frame.view, &frame.result, &truth, tracks));
        }
    }
    Ok(Summary::of(header, frames, tracking.metrics()))
}
