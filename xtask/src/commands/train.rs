//! `train`: a dataset to a model with its curves and its evaluation.

use super::load;
use crate::chain::of_classifier;
use crate::cli::TrainArguments;
use crate::failure::Failure;
use crate::output;
use crate::progress::Work;
use artifact::dataset::{CropFormat, Dataset, Sample};
use artifact::{ArtifactError, Provenance, Reader};
use classifier::{Augmentation, Schedule, TrainSettings, Trained};
use std::path::{Path, PathBuf};

pub(crate) fn run(arguments: &TrainArguments) -> Result<(), Failure> {
    let shards = load::shards(&arguments.dataset);
    let format = format_of(&arguments.dataset, &shards)?;
    output::claim(&classifier::MODEL_FILES.map(|name| arguments.out.join(name)))?;
    let settings = settings(arguments);
    let work = Work::begin("training");
    let mut progress = |p: classifier::Progress| work.at(p.iteration as usize, p.iterations as usize);
    let samples = shards.iter().flat_map(|shard| samples(shard));
    let trained =
        classifier::train(samples, &format, &settings, arguments.seed, &mut progress).map_err(of_classifier)?;
    drop(work);
    let from = provenance(arguments, &settings, &shards)?;
    classifier::save_model(&arguments.out, &trained, &from).map_err(of_classifier)?;
    tell(&trained);
    Ok(())
}

/// The paper's network on crops pooled to 113 × 113, four pixels in one: 7 cm × 0.07 m/s, finer than any cell.
fn settings(arguments: &TrainArguments) -> TrainSettings {
    TrainSettings {
        input_side: 113,
        iterations: arguments.iterations,
        schedule: Schedule::Cosine { warm_up: 20.min(arguments.iterations) },
        augmentation: Augmentation { range_shift_m: 0.75, velocity_shift_mps: 0.2, gain_db: 3.0, noise_db: 1.0 },
        ..TrainSettings::PAPER
    }
}

fn format_of(folder: &Path, shards: &[PathBuf]) -> Result<CropFormat, Failure> {
    let first =
        shards.first().ok_or_else(|| Failure::System(format!("{}: no shards of a dataset here", folder.display())))?;
    let format = *Reader::<Dataset>::open(first)?.header();
    for shard in shards {
        if *Reader::<Dataset>::open(shard)?.header() != format {
            let rule = "all shards of a dataset have one format of crops";
            return Err(Failure::Refused(format!("{}: differs from {}: {rule}", shard.display(), first.display())));
        }
    }
    Ok(format)
}

fn samples(shard: &Path) -> Box<dyn Iterator<Item = Result<Sample, ArtifactError>>> {
    match Reader::<Dataset>::open(shard) {
        Ok(reader) => Box::new(reader),
        Err(error) => Box::new(std::iter::once(Err(error))),
    }
}

fn provenance(arguments: &TrainArguments, settings: &TrainSettings, shards: &[PathBuf]) -> Result<Provenance, Failure> {
    Ok(Provenance {
        stage: "classifier".into(),
        program_version: env!("CARGO_PKG_VERSION").into(),
        inputs: load::hashed(shards)?,
        settings: serde_json::to_string(settings).map_err(Failure::refused)?,
        seed: arguments.seed,
    })
}

fn tell(trained: &Trained) {
    for (split, evaluation) in &trained.metrics.splits {
        let [low, high] = evaluation.accuracy_interval;
        output::line(format!(
            "{split:?}: {:.1} % of {} right (95 % interval {:.1} … {:.1} %)",
            100.0 * evaluation.accuracy,
            evaluation.samples,
            100.0 * low,
            100.0 * high
        ));
    }
}
