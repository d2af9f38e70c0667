//! Evaluation of a model (`evaluate`): its accuracy on datasets, by frame and by track, with its spread over
//! vehicles, as a page.

use crate::training::interval_text::interval_text;
use artifact::dataset::Sample;
use artifact::settings::Class;
use classifier::{
    ClassificationMetrics, Evaluation, Logits, Sightings, log_softmax, metrics_by_frame_and_track,
    track_logits,
};
use pipeline::chain::class_rule::{ClassRule, Predicted};
use pipeline::chain::loaded_model::{LoadedModel, classifier_failure_about};
use pipeline::host::dataset_folders::DatasetFolder;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use pipeline::host::safe_text::{in_markdown, markdown_table};
use std::fmt::Write;
use std::iter;
use std::path::{Path, PathBuf};

/// Number of samples that are classified at once.
const BATCH: usize = 256;
/// Lower limit of a frame's probabilities in the logarithm, which keeps its log loss finite.
const LEAST_PROBABILITY: f32 = 1e-6;

/// Settings of an evaluation.
pub struct EvaluationSettings {
    /// Model file or folder.
    pub model: PathBuf,
    /// Folders of datasets.
    pub datasets: Vec<PathBuf>,
    /// File of the page; `None`: none is written.
    pub out: Option<PathBuf>,
}

/// Evaluates a model and returns the page (Markdown).
///
/// # Errors
/// A sentence that names the file if a model or a shard is damaged, and the first folder if no sample has a
/// class.
pub fn run(settings: &EvaluationSettings) -> Result<String, Failure> {
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
        added.map_err(classifier_failure_about(shard))
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
    let (rule, correlation) = (model.rule(), f64::from(model.rule().frame_correlation));
    let of_frames: Vec<_> = seen.iter().map(|seen| seen.class).zip(logits.iter().copied()).collect();
    let told =
        [of_frames, track_logits(&seen, &logits, correlation)].map(|answers| predictions(rule, &answers));
    let page = page(&metrics_by_frame_and_track(&seen, &logits, correlation), &told, rule);
    settings.out.as_ref().map_or(Ok(()), |out| files::write_file(out, page.as_bytes()))?;
    Ok(page)
}

/// Reads all sightings of the shards of these folders.
pub(super) fn sightings_of(folders: &[DatasetFolder]) -> Result<Sightings, Failure> {
    let mut sightings = Sightings::default();
    each_shard(folders, |number, shard| {
        let added = sightings.add(number, classifier::samples_of(shard));
        added.map_err(classifier_failure_about(shard))
    })?;
    Ok(sightings)
}

/// Applies a function to each shard of these folders, with its folder's number.
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

/// True class of an answer, and the predicted class.
type Prediction = (usize, Predicted);

/// Predicted classes by a rule, each with the true one.
pub(super) fn predictions(rule: ClassRule, answers: &[(usize, Logits)]) -> Vec<Prediction> {
    let probabilities = |logits: &Logits| log_softmax(logits.map(f64::from)).map(|log| log.exp() as f32);
    answers.iter().map(|(class, logits)| (*class, rule.predict(&probabilities(logits)))).collect()
}

/// Text of the shares that are right, wrong and unknown, %.
pub(super) fn shares(told: &[Prediction]) -> String {
    let (mut counts, share) = ([0.0; 3], 100.0 / told.len().max(1) as f64);
    for (class, predicted) in told {
        let kind = match predicted {
            Predicted::Class(told) => usize::from(*told != Class::ALL[*class]),
            Predicted::Unknown => 2,
        };
        counts[kind] += share;
    }
    counts.map(|share| format!("{share:.0}")).join(" / ")
}

fn page(
    [frames, tracks]: &[ClassificationMetrics; 2],
    [of_frames, of_tracks]: &[Vec<Prediction>; 2],
    rule: ClassRule,
) -> String {
    let columns = [
        "answers",
        "number",
        "right, mean over classes",
        "95 % over vehicles",
        "log loss",
        "calibration error",
        "told right / wrong / unknown, %",
    ];
    let rows = [row("by frame", frames, of_frames), row("by track", tracks, of_tracks)];
    let mut page = markdown_table(&columns, rows);
    let _ = write!(
        page,
        "\nRight is an answer whose likeliest class is the true one. A class is told from a probability of \
         {} on; below it the answer is \"unknown\".\n",
        rule.least_probability
    );
    for (name, told) in [("By frame", of_frames), ("By track", of_tracks)] {
        let _ = write!(page, "\n{name}, rows true, columns told:\n\n{}", prediction_confusion(told));
    }
    let _ = write!(page, "\nBy vehicle, by track, told or not:\n\n{}", vehicles(&tracks.evaluation));
    page
}

fn row(name: &str, part: &ClassificationMetrics, told_classes: &[Prediction]) -> [String; 7] {
    let (told, evaluation) = (&part.by_vehicle, &part.evaluation);
    [
        name.to_owned(),
        told.answers.to_string(),
        format!("{:.1} %", 100.0 * told.mean_over_classes),
        format!("{} over {}", interval_text(told.interval), told.vehicles),
        format!("{:.3}", evaluation.log_loss),
        format!("{:.1} %", 100.0 * evaluation.calibration.expected_error),
        shares(told_classes),
    ]
}

/// Counts of predicted classes, and of answers without one, by the true class.
fn prediction_confusion(told: &[Prediction]) -> String {
    let [a, b, c, d] = Class::ALL.map(Class::name);
    let columns = Class::ALL.map(Predicted::Class).into_iter().chain([Predicted::Unknown]);
    let rows = Class::ALL.iter().enumerate().map(|(class, of)| {
        let count = |column| told.iter().filter(|answer| **answer == (class, column)).count().to_string();
        iter::once(of.name().to_owned()).chain(columns.clone().map(count)).collect::<Vec<_>>()
    });
    markdown_table(&["", a, b, c, d, Predicted::Unknown.name()], rows)
}

/// Counts of the likeliest classes by the true one.
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
