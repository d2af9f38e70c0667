//! Drawn scenes through the whole chain: samples of detected vehicles, and a line of truth and estimates.

use crate::dataset::draws::Drawn;
use crate::dataset::lines;
use crate::dataset::observed_frame::{SeenFrame, seen};
use crate::dataset::recipe::Recipe;
use crate::dataset::scene_line::SceneLine;
use crate::dataset::staging::{Staged, stage};
use artifact::dataset::{Crop, Sample};
use pipeline::chain::link::Chain;
use pipeline::chain::measured_frames::Known;
use pipeline::host::failure::Failure;
use pipeline::host::in_order::AtOnce;
use pipeline::host::memory::Allowance;
use std::sync::Arc;

/// A computed scene.
pub(super) struct Shot {
    /// Samples of all detected vehicles, frame by frame.
    pub(super) samples: Vec<Sample>,
    /// Truth and estimates.
    pub(super) line: SceneLine,
    /// Errors that scenes of the same kind take over.
    pub(super) measured: Measured,
}

/// Errors of a scene, with its number.
#[derive(Clone)]
pub(super) struct Measured {
    pub(super) scene: u64,
    known: Arc<Known>,
}

/// Parameters with which a scene is computed.
pub(super) struct Surroundings<'a> {
    /// Scene whose errors are taken over; `None`: they are measured.
    pub(super) like: Option<&'a Measured>,
    /// Name of the shard's file.
    pub(super) shard: &'a str,
    /// Number of scenes that share the memory.
    pub(super) at_once: usize,
    /// Memory allowed for tracing.
    pub(super) memory: Allowance,
}

/// Computes one scene.
pub(super) fn shoot(
    recipe: &Recipe,
    drawn: &Drawn,
    surroundings: &Surroundings<'_>,
) -> Result<Shot, Failure> {
    let staged = stage(recipe, drawn);
    let chain = Chain::of(&staged.header, None, None, surroundings.memory);
    chain.share_memory(AtOnce { workers: surroundings.at_once, held: surroundings.at_once });
    let chain = match surroundings.like {
        Some(measured) => chain.like(Known::clone(&measured.known), &measured.scene.to_string()),
        None => chain,
    };
    let (mut samples, mut frames) = (Vec::new(), Vec::new());
    for index in 0..staged.header.frames {
        let seen = seen(&staged, chain.frame(&chain.plan(index))?);
        samples.extend(samples_of(recipe, drawn, &staged, &chain, &seen)?);
        frames.push(lines::frame(drawn, &staged, &seen));
    }
    let own = || Measured { scene: drawn.number, known: Arc::new(chain.measured()) };
    let measured = surroundings.like.cloned().unwrap_or_else(own);
    Ok(Shot {
        samples,
        line: lines::scene(recipe, drawn, &staged, frames, measured.scene, surroundings.shard),
        measured,
    })
}

fn samples_of(
    recipe: &Recipe,
    drawn: &Drawn,
    staged: &Staged,
    chain: &Chain,
    seen: &SeenFrame,
) -> Result<Vec<Sample>, Failure> {
    let (points, rdm) = (&seen.products.result.points, &seen.products.rdm);
    let signatures = chain.receiver()?.signatures(rdm).map_err(Failure::refused)?;
    let mut samples = Vec::new();
    for (target, object) in
        seen.object_of.iter().enumerate().filter_map(|(t, object)| Some((t, (*object)? as u32)))
    {
        let (told, truth) = (&staged.vehicles[target], &seen.truths[target]);
        samples.push(Sample {
            id: lines::id(drawn.number, target, points.index),
            signature: signatures.of(points, object).map_err(Failure::refused)?,
            crop: recipe.asked.crops.then(|| crop(chain, seen, object)).transpose()?,
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
fn crop(chain: &Chain, seen: &SeenFrame, object: u32) -> Result<Crop, Failure> {
    let cropper = chain.receiver()?.cropper(&seen.products.rdm, &dsp::PAPER_CROP);
    cropper
        .and_then(|cropper| cropper.crop_among(&seen.products.result.points, object))
        .map_err(Failure::refused)
}
