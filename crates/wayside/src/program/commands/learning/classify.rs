//! `classify`: class and probabilities of every object of a map, or of every sample of a dataset, one JSON
//! line each.

use crate::program::commands::inspect;
use crate::program::learning_cli::ClassifyArguments;
use crate::program::terminal;
use artifact::dataset::{Dataset, Sample};
use artifact::rdm::Rdm;
use artifact::{Reader, Schema, read_preamble};
use pipeline::chain::loaded_model::LoadedModel;
use pipeline::host::dataset_folders::DatasetFolder;
use pipeline::host::failure::Failure;
use pipeline::host::progress::{self, Work};
use pipeline::outcome::summary::Probabilities;
use serde_json::json;
use std::path::{Path, PathBuf};

/// Number of samples that are classified at once.
const BATCH: usize = 64;

pub(crate) fn run(arguments: &ClassifyArguments) -> Result<(), Failure> {
    let model = LoadedModel::read(&arguments.model)?;
    let files: Vec<Vec<PathBuf>> =
        arguments.files.iter().map(|place| expanded(place)).collect::<Result<_, _>>()?;
    for file in files.into_iter().flatten() {
        match read_preamble(&file)?.schema.as_str() {
            Rdm::NAME => maps(&model, &file).map_err(|failure| failure.about(&file))?,
            Dataset::NAME => samples(&model, &file)?,
            other => return Err(unfit(&file, other)),
        }
    }
    Ok(())
}

/// Replaces a folder by the datasets in it.
fn expanded(place: &Path) -> Result<Vec<PathBuf>, Failure> {
    match place.is_dir() {
        true => Ok(DatasetFolder::open(place)?.shards),
        false => Ok(vec![place.to_owned()]),
    }
}

fn unfit(file: &Path, schema: &str) -> Failure {
    match schema {
        "scene" | "paths" | "rcs" | "cube" | "points" | "tracks" | "model" | "classes" => Failure::Refused(
            format!("{}: a `{schema}` artifact where maps or a dataset are needed", file.display()),
        ),
        other => inspect::unknown(file, other),
    }
}

fn maps(model: &LoadedModel, file: &Path) -> Result<(), Failure> {
    let reader = Reader::<Rdm>::open(file)?;
    let receiver = dsp::Receiver::new(reader.header()).map_err(Failure::refused)?;
    for rdm in progress::frames(reader) {
        let rdm = rdm?;
        let points = receiver.detect(&rdm).map_err(Failure::refused)?;
        terminal::cancellation().check()?;
        for (object, p) in model.classify(&receiver, &rdm, &points)?.iter().enumerate() {
            tell(model, file, rdm.index, &object.to_string(), p);
        }
    }
    Ok(())
}

fn samples(model: &LoadedModel, file: &Path) -> Result<(), Failure> {
    let mut reader = Reader::<Dataset>::open(file)?;
    let (under_way, of) = (Work::begin("samples"), reader.frames() as usize);
    let mut done = 0;
    loop {
        under_way.at(done, of);
        let batch: Vec<Sample> = reader.by_ref().take(BATCH).collect::<Result<_, _>>()?;
        if batch.is_empty() {
            return Ok(());
        }
        terminal::cancellation().check()?;
        for (sample, p) in batch.iter().zip(model.of_samples(&batch).map_err(|failure| failure.about(file))?)
        {
            tell(model, file, sample.frame, &sample.id, &p);
        }
        done += batch.len();
    }
}

fn tell(model: &LoadedModel, file: &Path, frame: u32, target: &str, p: &[f32; 4]) {
    terminal::line(json!({
        "file": file.display().to_string(), "frame": frame, "target": target,
        "class": model.rule().predict(p), "probabilities": Probabilities::of(Some(p)),
    }));
}
