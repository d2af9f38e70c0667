//! One run: a design in a situation through the whole chain to its summary, without files and pictures.

use crate::runs::run_accuracy::ErrorSource;
use crate::study::axis::AxisChoice;
use crate::study::document::Study;
use crate::study::situations::{Situation, changes_in};
use artifact::envelope::fingerprint;
use artifact::paths::ErrorOrigin;
use artifact::scene::SceneHeader;
use artifact::settings::Fidelity;
use pipeline::chain::cache::Cache;
use pipeline::chain::frames::resolved;
use pipeline::chain::link::{Chain, FrameProducts};
use pipeline::chain::loaded_model::LoadedModel;
use pipeline::chain::loading;
use pipeline::chain::measured_frames::FramesByIndex;
use pipeline::chain::stages::Stage;
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use pipeline::host::ordered_jobs::ConcurrencyLimits;
use pipeline::outcome::frame_truth::frame_truth;
use pipeline::outcome::summary::{FrameSummary, Summary};
use pipeline::outcome::tracking::Tracking;
use scene::{MeshLoading, ReadOptions};

/// Resources common to all runs of a study.
pub(crate) struct RunResources<'a> {
    pub(crate) cache: Option<&'a Cache>,
    pub(crate) model: Option<&'a LoadedModel>,
    pub(crate) memory: Allowance,
    /// Number of runs that share the memory.
    pub(crate) at_once: usize,
}

/// Interval of measurements: all frames of a run take over the errors of its first.
const MEASURED_EVERY: u32 = 1_000_000;

/// Path errors measured in one run, for others of its kind.
pub(crate) struct MeasuredErrors {
    frames: FramesByIndex,
    /// Hash of their inputs.
    hash: String,
}

/// Reads the scene of a design in a situation, with its models if requested.
pub(crate) fn read(
    study: &Study,
    design: &[AxisChoice],
    situation: &Situation,
    meshes: MeshLoading,
) -> Result<SceneHeader, Failure> {
    let changes = changes_in(study, design, situation);
    let options = ReadOptions { model: None, radar: study.radar.clone(), meshes };
    let header = scene::read_changed(&study.scene, &changes, &options).map_err(loading::scene_failure)?;
    let fidelity = Fidelity { measured_every: MEASURED_EVERY, ..header.fidelity };
    Ok(SceneHeader { seed: situation.seed, fidelity, ..header })
}

/// Measures the errors of a run's first frame.
pub(crate) fn measure_errors(
    header: &SceneHeader,
    resources: &RunResources,
) -> Result<MeasuredErrors, Failure> {
    let chain = chain(header, resources);
    let mut keys = vec![];
    for index in 0..header.radar.schedule.sub_frames().min(header.frames) {
        let plan = chain.plan(index);
        chain.scattering(&plan)?;
        keys.push(plan.keys.bart_rcs.id());
    }
    Ok(MeasuredErrors { frames: chain.measured(), hash: fingerprint(&keys) })
}

/// Summary of all frames of a scene, with errors of another run of its kind if given, and the run in which
/// its errors were measured.
pub(crate) fn summary(
    header: &SceneHeader,
    like: Option<&MeasuredErrors>,
    resources: &RunResources,
) -> Result<(Summary, ErrorSource), Failure> {
    let chain = chain(header, resources);
    let mut errors = ErrorSource::Own;
    let chain = match like {
        Some(measured) => chain.with_measured_errors(measured.frames.clone(), &measured.hash),
        None => chain,
    };
    let mut tracking = Tracking::of(&chain)?;
    let (mut frames, mut cycle) = (Vec::new(), Vec::new());
    for index in 0..header.frames {
        cycle.push(chain.frame(&chain.plan(index))?);
        if cycle.len() < header.radar.schedule.sub_frames() as usize {
            continue;
        }
        for frame in resolved(&chain, std::mem::take(&mut cycle))? {
            if like.is_some() && takes_over(&frame) {
                errors = ErrorSource::TakenOver;
            }
            let truth = frame_truth(&chain, &frame)?;
            let (_, tracks) = tracking.step(&frame, &truth)?;
            frames.push(FrameSummary::of(&frame.view, &frame.result, &truth, tracks));
        }
    }
    Ok((Summary::of(header, frames, tracking.metrics()), errors))
}

/// Whether a frame's errors were measured in another one; a frame uses its own if that one has no bodies.
fn takes_over(frame: &FrameProducts) -> bool {
    frame.result.scattering.paths().is_some_and(|paths| paths.trace.origin == ErrorOrigin::TakenOver)
}

/// The chain of a scene, which caches only scattering: later stages are computed quickly, and their frames
/// fill a disk.
fn chain<'a>(header: &'a SceneHeader, resources: &RunResources<'a>) -> Chain<'a> {
    let chain =
        Chain::of(header, resources.cache, resources.model, resources.memory).caching_up_to(Stage::BartRcs);
    chain.share_memory(ConcurrencyLimits { workers: resources.at_once, held: resources.at_once });
    chain
}
