//! Datasets, training, classes and how right they are.

pub(crate) mod classify;
pub(crate) mod dataset;
pub(crate) mod evaluate;
pub(crate) mod train;
pub(crate) mod protocols;

use crate::program::learning_cli::LearningCommand;
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use std::path::PathBuf;

/// Does what was asked.
pub(crate) fn dispatch(command: LearningCommand, memory: Allowance) -> Result<(), Failure> {
    match command {
        LearningCommand::Dataset(arguments) => {
            dataset::run(&arguments, memory).map_err(|failure| failure.about(&arguments.spec))
        }
        LearningCommand::Train(arguments) => train::run(&arguments).map_err(about_first(&arguments.datasets)),
        LearningCommand::Classify(arguments) => classify::run(&arguments),
        LearningCommand::Evaluate(arguments) => evaluate::run(&arguments),
        LearningCommand::Protocols(arguments) => {
            protocols::run(&arguments).map_err(about_first(&arguments.datasets))
        }
    }
}

/// Names the first of the folders, where what they hold together is refused.
fn about_first(folders: &[PathBuf]) -> impl FnOnce(Failure) -> Failure {
    move |failure| folders.iter().take(1).fold(failure, |failure, folder| failure.about(folder))
}
