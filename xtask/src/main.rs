//! `cargo xtask`: the only place where the stages meet. It parses, calls a stage, writes an artifact; physics lives in
//! the stages. Commands and files are promised in `docs/interface.md`.

mod cli;
mod suggestion;
mod values;
mod failure;
mod interrupt;
mod output;
mod progress;
mod measured_frames;
mod memory;
mod looks;
mod memory_estimate;
mod processor_time;
mod cache;
mod checkpoint;
mod keys;
mod stages;
mod plan;
mod loaded_model;
mod chain;
mod path_legs;
mod ground_outline;
mod truth;
mod labels;
mod metrics;
mod pairing;
mod frame_truth;
mod tracking;
mod verdict;
mod false_objects;
mod summary;
mod console;
mod sub_frames;
mod products;
mod several_radars;
mod expectation;
mod commands;
mod pictures;
mod report;

use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = cli::Arguments::parse_or_exit();
    interrupt::install();
    progress::configure(&arguments);
    memory::set_limit(arguments.memory_limit);
    let ended = limit_threads(arguments.threads).and_then(|()| commands::dispatch(arguments.command));
    progress::finish();
    match ended {
        Ok(()) => {
            output::finish(Ok(()));
            ExitCode::SUCCESS
        }
        Err(failure) => failure.report(),
    }
}

fn limit_threads(threads: Option<u16>) -> Result<(), failure::Failure> {
    let Some(threads) = threads else { return Ok(()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads)).build_global();
    pool.map_err(|e| failure::Failure::System(format!("--threads {threads}: {e}")))
}
