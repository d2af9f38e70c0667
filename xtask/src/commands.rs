//! One file per command.

mod bench;
mod cache;
mod calibrate;
mod ci;
mod classify;
mod dataset;
mod dsp;
mod echo;
mod evaluate;
pub(crate) mod export;
mod import;
mod inspect;
pub(crate) mod load;
mod paths;
mod protocols;
mod raw_data;
mod rcs;
mod run;
mod sidecar;
mod study;
mod train;
mod vehicles;

use crate::cli::Command;
use crate::failure::Failure;
use crate::progress::Work;

/// Does what was asked.
pub(crate) fn dispatch(command: Command) -> Result<(), Failure> {
    let _under_way = Work::begin(command.name());
    match command {
        Command::Run(arguments) => run::run(&arguments).map_err(|failure| failure.about(&arguments.scene.scene)),
        Command::Rcs(arguments) => rcs::run(&arguments).map_err(|failure| failure.about(&arguments.mesh)),
        Command::Paths(arguments) => paths::run(&arguments).map_err(|failure| failure.about(&arguments.scene.scene)),
        Command::Echo(arguments) => echo::run(&arguments).map_err(|failure| failure.about(&arguments.scene.scene)),
        Command::Dsp(arguments) => dsp::run(&arguments).map_err(|failure| failure.about(&arguments.cube)),
        Command::Dataset(arguments) => dataset::run(&arguments).map_err(|failure| failure.about(&arguments.spec)),
        Command::Train(arguments) => train::run(&arguments),
        Command::Classify(arguments) => classify::run(&arguments),
        Command::Evaluate(arguments) => evaluate::run(&arguments),
        Command::Protocols(arguments) => protocols::run(&arguments),
        Command::Import(arguments) => import::run(&arguments),
        Command::Calibrate(arguments) => calibrate::run(&arguments).map_err(|failure| failure.about(&arguments.cube)),
        Command::Export(arguments) => export::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Vehicles(arguments) => vehicles::run(&arguments),
        Command::Chart(arguments) => study::chart(&arguments),
        Command::Atlas(arguments) => study::atlas(&arguments),
        Command::Levels(arguments) => study::levels(&arguments),
        Command::Bench(arguments) => bench::run(&arguments),
        Command::Cache(arguments) => cache::run(&arguments),
        Command::Ci => ci::run(),
    }
}
