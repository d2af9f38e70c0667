//! Training (`train`): a dataset to a model with its curves and its evaluation.
//!
//! Models of signatures are trained here, the paper's network in a separate program.

mod settings;
pub(crate) mod interval_text;
mod lone_vehicles;
pub(crate) mod network;
mod signatures;

use crate::dataset::own_artifact::refuse_other_artifact;
use artifact::model::Model;
use artifact::settings::Class;
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
    files::refuse_foreign_head(&out.join(classifier::METRICS_FILE), are_metrics)?;
    files::refuse_foreign_head(&out.join(classifier::CURVES_FILE), are_curves)?;
    refuse_other_artifact::<Model>(&out.join(classifier::WEIGHTS_FILE))
}

/// Whether a file begins as the metrics of any learner do: with all classes, the seed and, soon after, the
/// temperature.
fn are_metrics(head: &[u8]) -> bool {
    let dense = |text: &str| text.split_whitespace().collect::<String>();
    let begin = dense(&format!("{{\"classes\":{:?},\"seed\":", Class::ALL.map(Class::name)));
    let text = dense(&String::from_utf8_lossy(head));
    text.starts_with(&begin) && text.contains("\"temperature\":")
}

/// Whether a file begins with the columns of any learner's curves.
fn are_curves(head: &[u8]) -> bool {
    let columns = head.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let known = signatures::CURVE_COLUMNS.into_iter().chain([classifier::NETWORK_CURVE_COLUMNS]);
    known.map(str::as_bytes).any(|known| known == columns)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_others_in_a_models_folder_are_refused_and_those_of_every_learner_are_not() {
        let folder = tempfile::tempdir().unwrap();
        let is_refused = |name: &str, text: &str| {
            let place = folder.path().join(name);
            std::fs::write(&place, text).unwrap();
            let refused = refuse_foreign(folder.path());
            std::fs::remove_file(place).unwrap();
            refused.is_err_and(|failure| matches!(failure, Failure::System(_)))
        };
        let own = "{\n  \"classes\": [\n    \"car\",\n    \"bus\",\n    \"truck\",\n    \"motorcycle\"\n  ],\n\
                   \"seed\": 7,\n  \"rounds\": 3,\n  \"temperature\": 1.0,\n";
        assert!(!is_refused("metrics.json", own) && !is_refused("metrics.json", ""));
        assert!(is_refused("metrics.json", "{\n  \"classes\": [\"cat\", \"dog\"],\n  \"seed\": 1\n}\n"));
        assert!(is_refused("metrics.json", "{\"classes\": 4}\n"));
        assert!(is_refused("curves.csv", "epoch,loss\n1,0.5\n"));
        assert!(is_refused("curves.csv", "trees,log_loss_on_unseen_vehicles,mine\n"));
        for columns in signatures::CURVE_COLUMNS.into_iter().chain([classifier::NETWORK_CURVE_COLUMNS]) {
            assert!(!is_refused("curves.csv", &format!("{columns}\n1,0.5\n")), "{columns}");
        }
        assert!(is_refused("weights.model", "mine") && !is_refused("weights.model", "WAYSIDE\n"));
    }
}
