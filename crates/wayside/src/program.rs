//! The program: command-line arguments, the terminal, and one file per command. `wayside` and `cargo xtask`
//! share it.

pub mod cli;
pub mod commands;
pub mod command_context;
pub mod terminal;
mod exit_codes;
mod export_formats;
pub mod interrupt;
mod out_extension;
#[cfg(feature = "classifier")]
mod learning_cli;
mod suggestion;
mod numbers;
pub mod values;
mod option_words;
#[cfg(test)]
mod refused_numbers;

use cli::General;
use command_context::CommandContext;
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use pipeline::host::progress::Work;
use reporting::report::ReportOrigin;
use std::process::ExitCode;

/// Runs the binary `wayside`.
pub fn main() -> ExitCode {
    let (arguments, word) = match cli::parsed::<cli::Arguments>() {
        Ok(parsed) => parsed,
        Err(code) => return code,
    };
    let command = arguments.command;
    terminal::expect(command.results());
    enter("wayside", word, &arguments.general, |context| commands::dispatch(command, context))
}

/// Carries out a command of the program called `program`: sets up threads, memory, progress and interrupts,
/// and returns the exit code (`docs/interface.md`).
pub fn enter(
    program: &str,
    command: String,
    general: &General,
    work: impl FnOnce(&CommandContext) -> Result<(), Failure>,
) -> ExitCode {
    interrupt::install();
    if !general.quiet {
        terminal::show_progress();
    }
    let words = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    let memory = Allowance::of(general.memory_limit);
    let context = CommandContext { command, memory, origin: ReportOrigin::by(program, words) };
    let ended = limit_threads(general.threads).and_then(|()| {
        let _under_way = Work::begin(context.command.as_str());
        work(&context)
    });
    exit_codes::of(ended)
}

fn limit_threads(threads: Option<u16>) -> Result<(), Failure> {
    let Some(threads) = threads else { return Ok(()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads)).build_global();
    pool.map_err(|e| Failure::System(format!("--threads {threads}: {e}")))
}
