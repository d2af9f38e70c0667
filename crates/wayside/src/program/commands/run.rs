//! `run`: a scene to everything that can be known of it.

use crate::program::cli::RunArguments;
use crate::program::means::Means;
use crate::program::terminal;
use crate::run::{self, Settings};
use pipeline::host::call_off::CallOff;
use pipeline::host::failure::Failure;

pub(crate) fn run(arguments: &RunArguments, means: &Means) -> Result<(), Failure> {
    let settings = Settings {
        scene: arguments.scene.source(),
        out: arguments.out.clone(),
        classifier: arguments.classifier.clone(),
        cache: (!arguments.no_cache).then(|| arguments.cache.location()),
        memory: means.memory,
        dry_run: arguments.dry_run,
        explain: arguments.explain,
        making: means.making.clone(),
        tell: &|line| terminal::line(line),
        call_off: CallOff::default(),
    };
    run::run(&settings).map(drop)
}
