//! `sweep`: a study of many designs that selects one.

use crate::program::cli::SweepArguments;
use crate::program::command_context::CommandContext;
use crate::program::interrupt;
use crate::program::terminal;
use pipeline::host::failure::Failure;
use reporting::report::ReportOrigin;
use std::path::Path;
use sweeps::Settings;

pub(crate) fn run(arguments: &SweepArguments, context: &CommandContext) -> Result<(), Failure> {
    interrupt::declare_saved("runs");
    let settings = Settings {
        study: arguments.study.clone(),
        out: arguments.out.clone(),
        shard: (!arguments.conclude).then_some([arguments.shard.number, arguments.shard.of]),
        seed: arguments.seed,
        classifier: arguments.classifier.clone(),
        cache: (!arguments.no_cache).then(|| arguments.cache.location()),
        memory: context.memory,
        command: command_of_the_whole(arguments, &context.origin.program),
        tell: &|line| terminal::line(line),
        cancellation: terminal::cancellation(),
    };
    sweeps::run(&settings).map(drop)
}

/// Command for the whole study: the report is the same whichever part writes it.
fn command_of_the_whole(arguments: &SweepArguments, program: &str) -> String {
    let place = |place: &Path| place.display().to_string();
    let mut words = vec!["sweep".to_owned(), place(&arguments.study), "--out".into(), place(&arguments.out)];
    words.extend(arguments.seed.into_iter().flat_map(|seed| ["--seed".into(), seed.to_string()]));
    words.extend(arguments.classifier.iter().flat_map(|model| ["--classifier".into(), place(model)]));
    ReportOrigin::by(program, words.into_iter()).command
}
