//! Predicted cost of a dataset: files and bytes from the counts of its recipe, processor time from the work
//! of some of its scenes (docs/engines.md).

use crate::dataset::draws::{self, DrawnScene, Kind};
use crate::dataset::layout::Layout;
use crate::dataset::recipe::Recipe;
use crate::dataset::staging::stage;
use artifact::scene::SceneHeader;
use pipeline::chain::expectation::Expectation;
use pipeline::chain::expectation::rates::SPREAD;
use pipeline::chain::link::Chain;
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use pipeline::host::progress::Work;
use std::collections::BTreeSet;
use std::ops::Range;

/// Number of scenes whose work is counted, equally many of each class.
const LOOKED_AT: u64 = 48;
/// Number of shards whose kinds of scenes are counted.
const SHARDS_LOOKED_AT: u64 = 8;

/// Bytes of a crop besides its pixels: places and length.
const CROP_HEAD_BYTES: f64 = 24.0;
/// Upper limit of the bytes of a sample without its crop, and of a shard without its samples (recipe and
/// hashes): measured on own vehicles before `intersection.toml` (docs/engines.md).
const SIGNATURE_BYTES: f64 = 1_650.0;
const SHARD_HEAD_BYTES: f64 = 1_500.0;
/// Bytes of a scene's line: per scene, per frame, and per vehicle in a frame.
const LINE_BYTES: [f64; 3] = [190.0, 360.0, 430.0];
/// Bytes of a sample's line in the manifest.
const MANIFEST_BYTES: f64 = 720.0;

const MIB: f64 = 1024.0 * 1024.0;

/// Counts of a recipe.
struct Counts {
    scenes: f64,
    frames: f64,
    shards: f64,
    /// Mean number of vehicles in a scene.
    vehicles: f64,
    /// Bytes of the image of a sample.
    crop_bytes: f64,
}

impl Counts {
    fn of(recipe: &Recipe, layout: &Layout) -> Self {
        let document = &recipe.document;
        let side = f64::from(dsp::PAPER_CROP.side);
        Self {
            scenes: layout.scenes as f64,
            frames: f64::from(document.frames),
            shards: layout.count() as f64,
            vehicles: document.vehicles_per_scene.map(f64::from).iter().sum::<f64>() / 2.0,
            crop_bytes: if document.crops { side * side + CROP_HEAD_BYTES } else { 0.0 },
        }
    }

    /// Number of samples if every vehicle is found in every frame.
    fn samples(&self) -> f64 {
        self.scenes * self.frames * self.vehicles
    }

    fn sample_bytes(&self) -> f64 {
        self.shards * SHARD_HEAD_BYTES + self.samples() * (SIGNATURE_BYTES + self.crop_bytes)
    }

    /// Bytes of a line per scene, beside its shard and in `scenes.jsonl`, and of a line per sample.
    fn line_bytes(&self) -> f64 {
        let [scene, frame, vehicle] = LINE_BYTES;
        let line = scene + self.frames * (frame + self.vehicles * vehicle);
        2.0 * self.scenes * line + self.samples() * MANIFEST_BYTES
    }
}

/// Mean processor seconds of a scene.
struct SceneSeconds {
    /// Seconds of a scene whose errors are measured, and of one that takes them over.
    measured: f64,
    like: f64,
    looked_at: usize,
}

/// Lines about the cost of a dataset: files, bytes, core-hours.
pub(super) fn lines(recipe: &Recipe, layout: &Layout, memory: Allowance) -> Result<Vec<String>, Failure> {
    let counts = Counts::of(recipe, layout);
    let seconds = scene_seconds(recipe, layout, memory)?;
    let measured = counts.shards * kinds_of_shard(recipe, layout);
    let all_s = counts.scenes * seconds.like + measured * (seconds.measured - seconds.like);
    let (shards, scenes) = (layout.count(), layout.scenes);
    Ok(vec![
        format!(
            "{scenes} scenes in {shards} shards of {}: {} files in {} folders, {} in one at most",
            layout.scenes_per_shard,
            2 * shards + 3,
            layout.folders(),
            layout.most_in_folder(),
        ),
        format!(
            "{} MiB of samples and {} MiB of lines if every vehicle is found",
            three_digits(counts.sample_bytes() / MIB),
            three_digits(counts.line_bytes() / MIB),
        ),
        format!(
            "{} core-hours, {} to {}, by the work of {} scenes: {} s of processor time a scene, {} s a shard",
            three_digits(all_s / 3600.0),
            three_digits(all_s / SPREAD / 3600.0),
            three_digits(all_s * SPREAD / 3600.0),
            seconds.looked_at,
            three_digits(all_s / counts.scenes),
            three_digits(all_s / counts.shards),
        ),
    ])
}

/// Number of kinds of scenes in a shard, each of which is measured once: the mean of the first shards.
fn kinds_of_shard(recipe: &Recipe, layout: &Layout) -> f64 {
    let shards = layout.all().take(SHARDS_LOOKED_AT as usize);
    let kinds = shards.map(|shard| {
        let scenes = draws::draw(recipe, shard.scenes);
        scenes.iter().map(DrawnScene::kind).collect::<BTreeSet<Kind>>().len() as f64
    });
    let kinds: Vec<f64> = kinds.collect();
    kinds.iter().sum::<f64>() / kinds.len().max(1) as f64
}

/// Looks at equally many scenes of each class, evenly spaced.
fn scene_seconds(recipe: &Recipe, layout: &Layout, memory: Allowance) -> Result<SceneSeconds, Failure> {
    let classes = recipe.models.len() as u64;
    let rounds = layout.scenes / classes;
    let looked_at = (LOOKED_AT / classes).min(rounds);
    let round = |look: u64| (2 * look + 1) * rounds / (2 * looked_at);
    let numbers: Vec<u64> = (0..looked_at)
        .flat_map(|look| (0..classes).map(move |class| round(look) * classes + class))
        .collect();
    let work = Work::begin("looking at scenes");
    let mut sum = [0.0; 2];
    for (number, scene) in numbers.iter().enumerate() {
        for drawn in draws::draw(recipe, *scene..*scene + 1) {
            let both = seconds_of(&stage(recipe, &drawn).header, memory)?;
            sum = [sum[0] + both[0], sum[1] + both[1]];
        }
        work.at(number + 1, numbers.len());
    }
    let [measured, like] = sum.map(|sum| sum / numbers.len().max(1) as f64);
    Ok(SceneSeconds { measured, like, looked_at: numbers.len() })
}

/// Processor seconds of a scene that is measured, and of one that takes its errors over: frames after the
/// first take them over in both, so one more frame represents the first of the other.
fn seconds_of(header: &SceneHeader, memory: Allowance) -> Result<[f64; 2], Failure> {
    let longer = SceneHeader { frames: header.frames + 1, ..header.clone() };
    let chain = Chain::of(&longer, None, None, memory);
    let first = frames_seconds(&chain, 0..1)?;
    let like = frames_seconds(&chain, 1..header.frames + 1)?;
    let one_like = like / f64::from(header.frames);
    Ok([first + like - one_like, like])
}

/// Seconds of frames without the program's start, which is shared by many scenes.
fn frames_seconds(chain: &Chain, frames: Range<u32>) -> Result<f64, Failure> {
    let plans: Vec<_> = frames.map(|index| chain.plan(index)).collect();
    let expected = Expectation::of(chain, None, &plans)?;
    Ok(expected.seconds - expected.start_seconds)
}

/// Text of a number to three digits, or as a whole number.
fn three_digits(number: f64) -> String {
    let digits = (2.0 - number.max(1e-3).log10().floor()).max(0.0) as usize;
    format!("{number:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_told_to_three_digits_or_whole() {
        assert_eq!(
            [0.0123, 0.64, 12.345, 197_430.2].map(three_digits),
            ["0.0123", "0.640", "12.3", "197430"]
        );
    }
}
