//! Training (`train`): a dataset to a model with its curves and its evaluation.
//!
//! Models of signatures are trained here, the paper's network in a separate program.

mod settings;
pub(crate) mod interval_text;
mod lone_vehicles;
pub(crate) mod network;
mod signatures;

use pipeline::chain::loaded_model::classifier_failure_about;
use pipeline::host::dataset_folders::DatasetFolder;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use std::path::{Path, PathBuf};

pub(crate) use lone_vehicles::note_lone_vehicles;
pub use network::{PROGRAM, target_folder};
pub use settings::{Learner, PAPER_ITERATIONS, TrainingSettings};

/// Trains a model and writes its folder.
///
/// # Errors
/// A sentence that names file and rule if a shard is damaged, a class is missing, or a setting does not apply
/// to the learner.
pub fn run(settings: &TrainingSettings) -> Result<(), Failure> {
    check(settings)?;
    let opened = DatasetFolder::open_all(&settings.datasets)?;
    for DatasetFolder { folder, shards } in &opened {
        classifier::format_of(shards).map_err(classifier_failure_about(folder))?;
    }
    let datasets: Vec<Vec<PathBuf>> = opened.into_iter().map(|dataset| dataset.shards).collect();
    files::claim(&classifier::MODEL_FILES.map(|name| settings.out.join(name)))?;
    refuse_foreign(&settings.out)?;
    match settings.learner.on_signatures() {
        Some(training) => signatures::train(settings, &training, &datasets),
        None => network::train(settings, &datasets.concat()),
    }
}

/// Refuses to replace files of another origin in the model's folder.
fn refuse_foreign(out: &Path) -> Result<(), Failure> {
    // The first key of metrics, and a column of both kinds of curves.
    let begins = |head: &[u8], with: &str, within: &str| {
        let text = String::from_utf8_lossy(head).into_owned();
        text.starts_with(with) && text.lines().take(2).any(|line| line.contains(within))
    };
    files::refuse_foreign_head(&out.join(classifier::METRICS_FILE), |head| begins(head, "{", "\"classes\""))?;
    files::refuse_foreign_head(&out.join(classifier::CURVES_FILE), |head| begins(head, "", "loss"))?;
    files::refuse_no_artifact(&out.join(classifier::WEIGHTS_FILE))
}

/// Refuses settings that do not apply to the learner.
fn check(settings: &TrainingSettings) -> Result<(), Failure> {
    match (settings.learner, &settings.attributions) {
        (learner, _) if learner.on_signatures().is_some() && settings.iterations.is_some() => {
            Err(iterations_of_signatures())
        }
        (Learner::Paper, Some(file)) => Err(Failure::System(format!(
            "{}: --attributions is for --learner trees, profile and both: the paper's network would not name them",
            file.display()
        ))),
        (Learner::Paper, None) => one_dataset_of_paper(&settings.datasets),
        _ => Ok(()),
    }
}

/// Refuses several datasets for the paper's network, whose training knows scenes by their numbers.
pub(crate) fn one_dataset_of_paper<T>(datasets: &[T]) -> Result<(), Failure> {
    match datasets.len() {
        0 | 1 => Ok(()),
        several => Err(Failure::System(format!(
            "--learner paper takes one dataset, not {several}: scenes of several have the same numbers"
        ))),
    }
}

/// Refusal of a number of steps for a training on signatures.
pub(crate) fn iterations_of_signatures() -> Failure {
    let rule = "--iterations is for --learner paper: the length of the other trainings is no option";
    Failure::System(rule.to_owned())
}
