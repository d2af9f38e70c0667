//! `classify`: class and probabilities of every object of a map, or of every sample of a dataset, one JSON
//! line each.

use crate::program::commands::inspect;
use crate::program::learning_cli::ClassifyArguments;
use crate::program::terminal;
use artifact::dataset::{Dataset, Sample};
use artifact::rdm::Rdm;
use artifact::{Reader, Schema, inputs, read_preamble};
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
    for file in expanded(&arguments.files)? {
        match read_preamble(&file)?.schema.as_str() {
            Rdm::NAME => maps(&model, &file).map_err(|failure| failure.about(&file))?,
            Dataset::NAME => samples(&model, &file)?,
            other => return Err(unfit(&file, other)),
        }
    }
    Ok(())
}

/// Replaces each folder by the datasets in it.
///
/// # Errors
/// Those of [`DatasetFolder::open_all`]; a dataset that is named twice, alone or beside its folder.
fn expanded(places: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let (folders, files): (Vec<PathBuf>, Vec<PathBuf>) =
        places.iter().cloned().partition(|place| place.is_dir());
    let opened = DatasetFolder::open_all(&folders)?;
    check_named_once(opened.iter().flat_map(|folder| &folder.shards).collect(), &files)?;
    let mut shards = opened.into_iter().map(|folder| folder.shards);
    let files_of = |place: &PathBuf| match folders.contains(place) {
        true => shards.next().unwrap_or_default(),
        false => vec![place.clone()],
    };
    Ok(places.iter().flat_map(files_of).collect())
}

/// Refuses a file of a dataset with the bytes of one that is `known`, or of another file.
fn check_named_once<'a>(mut known: Vec<&'a PathBuf>, files: &'a [PathBuf]) -> Result<(), Failure> {
    for file in files.iter().filter(|file| has_samples(file)) {
        for other in &known {
            if has_same_bytes(file, other)? {
                let (one, other) = (file.display(), other.display());
                return Err(Failure::System(format!(
                    "{one}: has the samples of {other}; each is taken once"
                )));
            }
        }
        known.push(file);
    }
    Ok(())
}

/// Whether a file is a dataset with samples; what cannot be opened is refused in its turn.
fn has_samples(file: &Path) -> bool {
    let is_dataset = read_preamble(file).is_ok_and(|preamble| preamble.schema == Dataset::NAME);
    is_dataset && Reader::<Dataset>::open(file).is_ok_and(|reader| reader.frames() > 0)
}

/// Whether two files have the same bytes; only files of one length are read.
fn has_same_bytes(one: &Path, other: &Path) -> Result<bool, Failure> {
    let unread = |file: &Path, error: std::io::Error| Failure::system(file, "read", error);
    let length = |file: &Path| std::fs::metadata(file).map(|about| about.len()).map_err(|e| unread(file, e));
    let hash = |file: &Path| inputs::named_hash(file).map(|(_, hash)| hash).map_err(|e| unread(file, e));
    Ok(length(one)? == length(other)? && hash(one)? == hash(other)?)
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
