//! Evaluation of a model (`evaluate`): how often it is right on datasets, by frame and by track, with its
//! spread over vehicles, as a page.

use crate::training::interval_text::told_interval;
use artifact::dataset::Sample;
use artifact::settings::Class;
use classifier::{Evaluation, Part, Sightings, parts};
use pipeline::chain::loaded_model::{LoadedModel, of_classifier_about};
use pipeline::host::dataset_folders::DatasetFolder;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use pipeline::host::safe_text::{in_markdown, markdown_table};
use std::fmt::Write;
use std::iter;
use std::path::{Path, PathBuf};

/// Samples that are answered at once.
const BATCH: usize = 256;
/// The logarithm of no probability is lower.
const LEAST_PROBABILITY: f32 = 1e-6;

/// Settings of an evaluation.
pub struct Settings {
    /// Model file or folder.
    pub model: PathBuf,
    /// Folders of datasets.
    pub datasets: Vec<PathBuf>,
    /// File of the page; `None`: none is written.
    pub out: Option<PathBuf>,
}

/// Evaluates a model; gives the page (Markdown).
///
/// # Errors
/// A sentence that names the file where a model or a shard is damaged, or of another radar's signatures, and
/// the first folder where no sample tells its class.
pub fn run(settings: &Settings) -> Result<String, Failure> {
    let model = LoadedModel::read(&settings.model)?;
    let datasets = DatasetFolder::open_all(&settings.datasets)?;
    if let Some(out) = &settings.out {
        files::claim(std::slice::from_ref(out))?;
    }
    let mut sightings = Sightings::default();
    let mut logits = Vec::new();
    each_shard(&datasets, |number, shard| {
        let samples: Vec<Sample> = classifier::samples_of(shard).collect::<Result<_, _>>()?;
        logits.extend(answers(&model, &samples).map_err(|failure| failure.about(shard))?);
        let added = sightings.add(number, samples.into_iter().map(Ok));
        added.map_err(of_classifier_about(shard))
    })?;
    if sightings.all.is_empty() {
        let rule = "no sample that tells its class: there is nothing to be right about";
        return Err(settings
            .datasets
            .iter()
            .take(1)
            .fold(Failure::refused(rule), |f, folder| f.about(folder)));
    }
    let seen: Vec<_> = sightings.all.iter().collect();
    let told = parts(&seen, &logits, f64::from(model.rule().frame_correlation));
    let page = page(&told);
    settings.out.as_ref().map_or(Ok(()), |out| files::write_file(out, page.as_bytes()))?;
    Ok(page)
}

/// Everything that the shards of these folders hold.
pub(super) fn sightings_of(folders: &[DatasetFolder]) -> Result<Sightings, Failure> {
    let mut sightings = Sightings::default();
    each_shard(folders, |number, shard| {
        let added = sightings.add(number, classifier::samples_of(shard));
        added.map_err(of_classifier_about(shard))
    })?;
    Ok(sightings)
}

/// Does something with each shard of these folders, and with its folder's number.
fn each_shard(
    folders: &[DatasetFolder],
    mut visit: impl FnMut(usize, &Path) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let of = folders.iter().map(|folder| folder.shards.len()).sum();
    let numbered = folders
        .iter()
        .enumerate()
        .flat_map(|(number, folder)| folder.shards.iter().map(move |shard| (number, shard)));
    progress::counted("shards", numbered, of).try_for_each(|(number, shard)| visit(number, shard))
}

/// Logarithms of the probabilities of the samples that have a class.
fn answers(model: &LoadedModel, samples: &[Sample]) -> Result<Vec<[f32; 4]>, Failure> {
    let mut answers = Vec::new();
    for batch in samples.chunks(BATCH) {
        let told = model.of_samples(batch)?;
        let labelled = batch.iter().zip(told).filter(|(sample, _)| sample.class.is_some());
        answers.extend(labelled.map(|(_, p)| p.map(|p| p.max(LEAST_PROBABILITY).ln())));
    }
    Ok(answers)
}

fn page([frames, tracks]: &[Part; 2]) -> String {
    let columns = [
        "answers",
        "number",
        "right, mean over classes",
        "95 % over vehicles",
        "log loss",
        "calibration error",
    ];
    let mut page = markdown_table(&columns, [row("by frame", frames), row("by track", tracks)]);
    for (name, part) in [("By frame", frames), ("By track", tracks)] {
        let _ = write!(page, "\n{name}, rows true, columns told:\n\n{}", confusion(&part.evaluation));
    }
    let _ = write!(page, "\nBy vehicle, by track:\n\n{}", vehicles(&tracks.evaluation));
    page
}

fn row(name: &str, part: &Part) -> [String; 6] {
    let (told, evaluation) = (&part.by_vehicle, &part.evaluation);
    [
        name.to_owned(),
        told.answers.to_string(),
        format!("{:.1} %", 100.0 * told.mean_over_classes),
        format!("{} over {}", told_interval(told.interval), told.vehicles),
        format!("{:.3}", evaluation.log_loss),
        format!("{:.1} %", 100.0 * evaluation.calibration.expected_error),
    ]
}

pub(super) fn confusion(evaluation: &Evaluation) -> String {
    let [a, b, c, d] = Class::ALL.map(Class::name);
    let rows = Class::ALL.iter().zip(&evaluation.confusion).map(|(class, told)| {
        iter::once(class.name().to_owned()).chain(told.iter().map(u64::to_string)).collect::<Vec<_>>()
    });
    markdown_table(&["", a, b, c, d], rows)
}

fn vehicles(evaluation: &Evaluation) -> String {
    let rows = evaluation.by_model.iter().map(|(model, told)| {
        let right = 100.0 * told.right as f64 / told.samples.max(1) as f64;
        [in_markdown(model).into_owned(), told.samples.to_string(), format!("{right:.0} %")]
    });
    markdown_table(&["vehicle", "tracks", "right"], rows)
}
