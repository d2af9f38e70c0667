//! `sweep`: a study of many designs to the one to take.

use crate::host::call_off::CallOff;
use crate::host::failure::Failure;
use crate::program::cli::SweepArguments;
use crate::program::means::Means;
use crate::program::terminal;
use crate::sweep::{self, Settings};

pub(crate) fn run(arguments: &SweepArguments, means: &Means) -> Result<(), Failure> {
    let settings = Settings {
        study: arguments.study.clone(),
        out: arguments.out.clone(),
        shard: [arguments.shard.number, arguments.shard.of],
        seed: arguments.seed,
        classifier: arguments.classifier.clone(),
        cache: (!arguments.no_cache).then(|| arguments.cache.location()),
        memory: means.memory,
        command: means.making.command.clone(),
        tell: &|line| terminal::line(line),
        call_off: CallOff::default(),
    };
    sweep::run(&settings).map(drop)
}
