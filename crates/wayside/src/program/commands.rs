//! One file per command.

mod cache;
mod calibrate;
mod dsp;
mod echo;
mod export;
mod import;
mod inspect;
mod paths;
mod rcs;
mod run;
mod scene_from;
mod score;
mod sweep;
mod vehicles;
#[cfg(feature = "classifier")]
mod learning;

use crate::program::cli::Command;
use crate::program::command_context::CommandContext;
use crate::program::out_extension;
use pipeline::host::failure::Failure;

#[cfg(feature = "classifier")]
pub use ::learning::training::{PROGRAM as TRAINING_PROGRAM, target_folder as training_target_folder};

/// Carries out a command.
pub fn dispatch(command: Command, context: &CommandContext) -> Result<(), Failure> {
    let memory = context.memory;
    out_extension::check(&command, &context.command)?;
    match command {
        Command::Run(arguments) => run::run(&arguments, context),
        Command::Rcs(arguments) => {
            rcs::run(&arguments, memory).map_err(|failure| failure.about(&arguments.mesh))
        }
        Command::Paths(arguments) => {
            paths::run(&arguments, memory).map_err(|failure| failure.about(&arguments.scene.scene))
        }
        Command::Echo(arguments) => {
            echo::run(&arguments, memory).map_err(|failure| failure.about(&arguments.scene.scene))
        }
        Command::Dsp(arguments) => dsp::run(&arguments).map_err(|failure| failure.about(&arguments.cube)),
        #[cfg(feature = "classifier")]
        Command::Learning(command) => learning::dispatch(command, memory),
        Command::Sweep(arguments) => {
            sweep::run(&arguments, context).map_err(|failure| failure.about(&arguments.study))
        }
        Command::Score(arguments) => {
            score::run(&arguments).map_err(|failure| failure.about(&arguments.points))
        }
        Command::Import(arguments) => import::run(&arguments),
        Command::SceneFrom(arguments) => scene_from::run(&arguments),
        Command::Calibrate(arguments) => {
            calibrate::run(&arguments).map_err(|failure| failure.about(&arguments.cube))
        }
        Command::Export(arguments) => {
            export::run(&arguments).map_err(|failure| failure.about(&arguments.file))
        }
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Vehicles(arguments) => vehicles::run(&arguments),
        Command::Cache(arguments) => cache::run(&arguments),
    }
}
