//! `cargo xtask`: every command of the program `wayside`, and developer commands: checks, studies,
//! benchmarks.

mod cli;
mod project;
mod processes;
mod random_scenes;
mod house;
mod bytes;
mod scene_keys;
mod fuzz_ledger;
mod dist;
mod study;
mod bench;
mod ci;

use cli::{Command, PageArguments};
use std::process::ExitCode;
use wayside::Failure;
use wayside::program::command_context::CommandContext;
use wayside::program::commands::dispatch;
use wayside::program::{self, terminal};

fn main() -> ExitCode {
    let (arguments, word) = match program::cli::parsed::<cli::Arguments>() {
        Ok(parsed) => parsed,
        Err(code) => return code,
    };
    let command = arguments.command;
    terminal::expect(command.results());
    program::enter("cargo xtask", word, &arguments.general, |context| carry_out(command, context))
}

fn carry_out(command: Command, context: &CommandContext) -> Result<(), Failure> {
    match command {
        Command::Wayside(command) => dispatch(command, context),
        Command::Chart(arguments) => study::plotted_studies::chart(&arguments),
        Command::Atlas(arguments) => study::plotted_studies::atlas(&arguments),
        Command::Levels(arguments) => study::plotted_studies::levels(&arguments),
        Command::Study(arguments) => study::run(&arguments),
        Command::Bench(arguments) => bench::run(&arguments),
        Command::Bytes(arguments) => bytes::run(&arguments),
        Command::House => house::run(),
        Command::SceneKeys => scene_keys::run(),
        Command::FuzzLedger(arguments) => {
            fuzz_ledger::run(&arguments)?;
            study::run(&PageArguments { name: Some("fuzz".into()), ..PageArguments::default() })
        }
        Command::Dist(arguments) => dist::run(&arguments),
        Command::Ci(arguments) => ci::run(&arguments),
    }
}
