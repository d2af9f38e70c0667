//! Datasets, training, classification and evaluation: requests are handed to the crate `learning`.

pub(crate) mod classify;

use crate::program::interrupt;
use crate::program::learning_cli::{
    DatasetArguments, EvaluateArguments, LearnerWord, LearningCommand, ProtocolsArguments, TrainArguments,
};
use crate::program::terminal;
use ::learning::dataset::Task;
use ::learning::training::Learner;
use ::learning::{dataset, evaluation, protocols, training};
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use std::path::PathBuf;

/// Carries out a command.
pub(crate) fn dispatch(command: LearningCommand, memory: Allowance) -> Result<(), Failure> {
    match command {
        LearningCommand::Dataset(arguments) => {
            if !arguments.dry_run {
                interrupt::declare_saved("shards");
            }
            dataset::run(&of_dataset(&arguments, memory)).map_err(|failure| failure.about(&arguments.spec))
        }
        LearningCommand::Train(arguments) => {
            training::run(&of_training(&arguments)).map_err(about_first(&arguments.datasets))
        }
        LearningCommand::Classify(arguments) => classify::run(&arguments),
        LearningCommand::Evaluate(arguments) => evaluation::run(&of_evaluation(&arguments)).map(tell_page),
        LearningCommand::Protocols(arguments) => {
            protocols::run(&of_protocols(&arguments)).map(tell_page).map_err(about_first(&arguments.datasets))
        }
    }
}

/// Adds the name of the first folder to a refusal of their joint content.
fn about_first(folders: &[PathBuf]) -> impl FnOnce(Failure) -> Failure {
    move |failure| folders.iter().take(1).fold(failure, |failure, folder| failure.about(folder))
}

/// Prints a page as lines of results.
fn tell_page(page: String) {
    terminal::lines(page.trim_end());
}

fn tell(line: &str) {
    terminal::line(line);
}

fn of_dataset(arguments: &DatasetArguments, memory: Allowance) -> dataset::DatasetSettings<'static> {
    let DatasetArguments { spec, out, shard, conclude, dry_run, seed } = arguments;
    let task = match (dry_run, conclude) {
        (true, _) => Task::Predict,
        (_, true) => Task::Conclude,
        _ => Task::Make { shard: [shard.number, shard.of] },
    };
    dataset::DatasetSettings {
        recipe: spec.clone(),
        out: out.clone(),
        seed: *seed,
        task,
        memory,
        tell: &tell,
    }
}

fn of_training(arguments: &TrainArguments) -> training::TrainingSettings<'static> {
    let TrainArguments { datasets, out, learner, seed, iterations, attributions } = arguments;
    training::TrainingSettings {
        datasets: datasets.clone(),
        out: out.clone(),
        learner: learner_of(*learner),
        seed: *seed,
        iterations: *iterations,
        attributions: attributions.clone(),
        tell: &tell,
    }
}

fn of_evaluation(arguments: &EvaluateArguments) -> evaluation::EvaluationSettings {
    let EvaluateArguments { model, datasets, out } = arguments.clone();
    evaluation::EvaluationSettings { model, datasets, out }
}

fn of_protocols(arguments: &ProtocolsArguments) -> protocols::ProtocolSettings<'static> {
    let ProtocolsArguments { datasets, test, learner, iterations, seeds, curves, out } = arguments.clone();
    let learner = learner_of(learner);
    protocols::ProtocolSettings { datasets, test, learner, iterations, seeds, curves, out, tell: &tell }
}

fn learner_of(word: LearnerWord) -> Learner {
    match word {
        LearnerWord::Profile => Learner::Profile,
        LearnerWord::Both => Learner::Both,
        LearnerWord::Trees => Learner::Trees,
        LearnerWord::Paper => Learner::Paper,
    }
}
