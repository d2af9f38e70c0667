//! `run`: a scene to all of its results.

use crate::program::cli::RunArguments;
use crate::program::command_context::CommandContext;
use crate::program::interrupt;
use crate::program::terminal;
use crate::run::{self, Settings};
use pipeline::chain::cache::{self, Cache, CacheLocation};
use pipeline::host::failure::Failure;

pub(crate) fn run(arguments: &RunArguments, context: &CommandContext) -> Result<(), Failure> {
    let cache = (!arguments.no_cache).then(|| arguments.cache.location());
    if !arguments.dry_run && is_cached(cache.as_ref()) {
        interrupt::declare_saved_as("frames", cache::saved_work);
    }
    let settings = Settings {
        scene: arguments.scene.source(),
        out: arguments.out.clone(),
        classifier: arguments.classifier.clone(),
        cache,
        memory: context.memory,
        dry_run: arguments.dry_run,
        explain: arguments.explain,
        origin: context.origin.clone(),
        tell: &|line| terminal::line(line),
        cancellation: terminal::cancellation(),
    };
    run::run(&settings).map(drop)
}

/// Whether there is a cache folder.
fn is_cached(location: Option<&CacheLocation>) -> bool {
    location.is_some_and(|location| Cache::open(location).is_ok_and(|cache| cache.is_some()))
}
