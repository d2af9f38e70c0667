//! Drawn scenes through the whole chain: samples of detected vehicles, and a line of truth and estimates.

use crate::dataset::draws::DrawnScene;
use crate::dataset::lines;
use crate::dataset::observed_frame::{ObservedFrame, observe};
use crate::dataset::recipe::Recipe;
use crate::dataset::scene_line::SceneLine;
use crate::dataset::staging::{StagedScene, stage};
use artifact::dataset::{Crop, Sample};
use artifact::scene::SceneHeader;
use pipeline::chain::frames::resolved;
use pipeline::chain::link::{Chain, FrameProducts};
use pipeline::chain::measured_frames::FramesByIndex;
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use pipeline::host::ordered_jobs::ConcurrencyLimits;
use std::ops::Range;
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
    for cycle in cycles(&staged.header) {
        for products in cycle_of_frames(&chain, cycle)? {
            let observed = observe(&staged, products);
            samples.extend(samples_of(recipe, drawn, &staged, &chain, &observed)?);
            frames.push(lines::frame(drawn, &staged, &observed));
        }
    }
    let own = || MeasuredErrors { scene: drawn.number, known: Arc::new(chain.measured()) };
    let measured = context.like.cloned().unwrap_or_else(own);
    Ok(ComputedScene {
        samples,
        line: lines::scene(recipe, drawn, &staged, frames, measured.scene, context.shard),
        measured,
    })
}

/// Frame records of each cycle of sub-frames; the last cycle may lack some.
fn cycles(header: &SceneHeader) -> impl Iterator<Item = Range<u32>> + use<> {
    let (frames, sub_frames) = (header.frames, header.radar.schedule.sub_frames());
    (0..frames).step_by(sub_frames as usize).map(move |first| first..frames.min(first + sub_frames))
}

/// Computes the sub-frames of a cycle, their velocities resolved by each other.
fn cycle_of_frames(chain: &Chain, cycle: Range<u32>) -> Result<Vec<FrameProducts>, Failure> {
    resolved(chain, cycle.map(|index| chain.frame(&chain.plan(index))).collect::<Result<_, _>>()?)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::draws;

    /// Two spans that fold 20 m/s to different velocities.
    const BASE: &str = "name = \"base\"\n[radar.waveform]\nchirps = 64\nsub_frame_idle_us = [10.0, 37.0]\n\
[radar.array]\npreset = \"1x4\"\n[noise]\nnoise_figure_db = 12.0\n[dsp]\ntraining_cells = [3, 6]\n\
[fidelity]\nbounces = 1\n";

    const RECIPE: &str = "scene = \"base.toml\"\nseed = 1\nscenes_per_class = 1\nrange_m = [30.0, 30.0]\n\
speed_mps = [20.0, 20.0]\nlanes = [2]\nframes = 2\ncrops = false\n[models]\ncar = [\"car-hatchback\"]\n";

    #[test]
    fn a_vehicle_is_found_in_each_sub_frame_with_the_velocity_that_both_tell() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("base.toml"), BASE).unwrap();
        std::fs::write(folder.path().join("spec.toml"), RECIPE).unwrap();
        let recipe = Recipe::read(&folder.path().join("spec.toml"), None).unwrap();
        let drawn = &draws::draw(&recipe, 0..1)[0];
        let memory = Allowance::of(None);
        let context = SceneContext { like: None, shard: "shard-0000.dataset", at_once: 1, memory };
        let scene = compute(&recipe, drawn, &context).unwrap();
        assert_eq!(scene.samples.iter().map(|sample| sample.frame).collect::<Vec<_>>(), [0, 1]);
        for (sample, (_, vehicle)) in scene.samples.iter().zip(scene.line.vehicles()) {
            let found_mps = vehicle.estimate.as_ref().and_then(|estimate| estimate.velocity_mps).unwrap();
            assert_eq!(sample.signature.radial_velocity_mps, found_mps);
            // Echoes of one body differ by less than a fraction of either span.
            let error_mps = (found_mps - sample.radial_velocity_mps).abs();
            assert!(error_mps < 1.0, "frame {}: {found_mps} m/s, off by {error_mps}", sample.frame);
        }
    }

    #[test]
    fn the_last_cycle_has_the_sub_frames_that_are_left() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("base.toml"), BASE).unwrap();
        let recipe = RECIPE.replace("frames = 2", "frames = 3");
        std::fs::write(folder.path().join("spec.toml"), recipe).unwrap();
        let recipe = Recipe::read(&folder.path().join("spec.toml"), None).unwrap();
        let staged = stage(&recipe, &draws::draw(&recipe, 0..1)[0]);
        assert_eq!(cycles(&staged.header).collect::<Vec<_>>(), [0..2, 2..3]);
    }
}
