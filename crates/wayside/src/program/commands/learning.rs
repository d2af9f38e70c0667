//! Datasets, training, classes and how right they are.

pub(crate) mod classify;
pub(crate) mod dataset;
pub(crate) mod evaluate;
pub(crate) mod train;
pub(crate) mod protocols;

use crate::host::failure::Failure;
use crate::host::memory::Allowance;
use crate::program::learning_cli::LearningCommand;

/// Does what was asked.
pub(crate) fn dispatch(command: LearningCommand, memory: Allowance) -> Result<(), Failure> {
    match command {
        LearningCommand::Dataset(arguments) => {
            dataset::run(&arguments, memory).map_err(|failure| failure.about(&arguments.spec))
        }
        LearningCommand::Train(arguments) => train::run(&arguments),
        LearningCommand::Classify(arguments) => classify::run(&arguments),
        LearningCommand::Evaluate(arguments) => evaluate::run(&arguments),
        LearningCommand::Protocols(arguments) => protocols::run(&arguments),
    }
}
