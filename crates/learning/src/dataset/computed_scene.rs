//! Drawn scenes through the whole chain: samples of detected vehicles, and a line of truth and estimates.

use crate::dataset::draws::DrawnScene;
use crate::dataset::lines;
use crate::dataset::observed_frame::{ObservedFrame, observe};
use crate::dataset::recipe::Recipe;
use crate::dataset::scene_line::SceneLine;
use crate::dataset::staging::{StagedScene, stage};
use artifact::dataset::{Crop, Sample};
use pipeline::chain::link::Chain;
use pipeline::chain::measured_frames::FramesByIndex;
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use pipeline::host::ordered_jobs::ConcurrencyLimits;
use std::sync::Arc;

/// A computed scene.
pub(super) struct ComputedScene {
    /// Samples of all detected vehicles, frame by frame.
    pub(super) samples: Vec<Sample>,
    /// Truth and estimates.
    pub(super) line: SceneLine,
    /// Errors that scenes of the same kind take over.
    pub(super) measured: MeasuredErrors,
}

/// Errors of a scene, with its number.
#[derive(Clone)]
pub(super) struct MeasuredErrors {
    pub(super) scene: u64,
    known: Arc<FramesByIndex>,
}

/// Parameters with which a scene is computed.
pub(super) struct SceneContext<'a> {
    /// Scene whose errors are taken over; `None`: they are measured.
    pub(super) like: Option<&'a MeasuredErrors>,
    /// Name of the shard's file.
    pub(super) shard: &'a str,
    /// Number of scenes that share the memory.
    pub(super) at_once: usize,
    /// Memory allowed for tracing.
    pub(super) memory: Allowance,
}

/// Computes one scene.
pub(super) fn compute(
    recipe: &Recipe,
    drawn: &DrawnScene,
    context: &SceneContext<'_>,
) -> Result<ComputedScene, Failure> {
    let staged = stage(recipe, drawn);
    let chain = Chain::of(&staged.header, None, None, context.memory);
    chain.share_memory(ConcurrencyLimits { workers: context.at_once, held: context.at_once });
    let chain = match context.like {
        Some(measured) => {
            chain.with_measured_errors(FramesByIndex::clone(&measured.known), &measured.scene.to_string())
        }
        None => chain,
    };
    let (mut samples, mut frames) = (Vec::new(), Vec::new());
    for index in 0..staged.header.frames {
        let observed = observe(&staged, chain.frame(&chain.plan(index))?);
        samples.extend(samples_of(recipe, drawn, &staged, &chain, &observed)?);
        frames.push(lines::frame(drawn, &staged, &observed));
    }
    let own = || MeasuredErrors { scene: drawn.number, known: Arc::new(chain.measured()) };
    let measured = context.like.cloned().unwrap_or_else(own);
    Ok(ComputedScene {
        samples,
        line: lines::scene(recipe, drawn, &staged, frames, measured.scene, context.shard),
        measured,
    })
}

fn samples_of(
    recipe: &Recipe,
    drawn: &DrawnScene,
    staged: &StagedScene,
    chain: &Chain,
    observed: &ObservedFrame,
) -> Result<Vec<Sample>, Failure> {
    let (points, rdm) = (&observed.products.result.points, &observed.products.rdm);
    let signatures = chain.receiver()?.signatures(rdm).map_err(Failure::refused)?;
    let mut samples = Vec::new();
    for (target, object) in
        observed.object_of.iter().enumerate().filter_map(|(t, object)| Some((t, (*object)? as u32)))
    {
        let (told, truth) = (&staged.vehicles[target], &observed.truths[target]);
        samples.push(Sample {
            id: lines::id(drawn.number, target, points.index),
            signature: signatures.of(points, object).map_err(Failure::refused)?,
            crop: recipe.document.crops.then(|| crop(chain, observed, object)).transpose()?,
            class: Some(told.class),
            model: told.model.clone(),
            variant: told.variant,
            scene: drawn.number,
            target: target as u32,
            frame: points.index,
            split: classifier::split_of_scene(drawn.number, recipe.seed),
            range_m: truth.range_m,
            radial_velocity_mps: truth.radial_velocity_mps,
            lane: truth.lane,
            seed: recipe.seed,
        });
    }
    Ok(samples)
}

/// Crop of the map around an object, as a detector shows it among its neighbours.
fn crop(chain: &Chain, observed: &ObservedFrame, object: u32) -> Result<Crop, Failure> {
    let cropper = chain.receiver()?.cropper(&observed.products.rdm, &dsp::PAPER_CROP);
    cropper
        .and_then(|cropper| cropper.crop_among(&observed.products.result.points, object))
        .map_err(Failure::refused)
}
