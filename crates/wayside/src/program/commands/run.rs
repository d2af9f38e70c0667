//! `run`: a scene to all of its results.

use crate::program::cli::RunArguments;
use crate::program::interrupt;
use crate::program::means::Means;
use crate::program::terminal;
use crate::run::{self, Settings};
use pipeline::chain::cache::{self, Cache, CacheLocation};
use pipeline::host::failure::Failure;

pub(crate) fn run(arguments: &RunArguments, means: &Means) -> Result<(), Failure> {
    let cache = (!arguments.no_cache).then(|| arguments.cache.location());
    if !arguments.dry_run && is_cached(cache.as_ref()) {
        interrupt::keeps_as_told("frames", cache::kept_work);
    }
    let settings = Settings {
        scene: arguments.scene.source(),
        out: arguments.out.clone(),
        classifier: arguments.classifier.clone(),
        cache,
        memory: means.memory,
        dry_run: arguments.dry_run,
        explain: arguments.explain,
        making: means.making.clone(),
        tell: &|line| terminal::line(line),
        call_off: terminal::call_off(),
    };
    run::run(&settings).map(drop)
}

/// Whether there is a cache folder.
fn is_cached(location: Option<&CacheLocation>) -> bool {
    location.is_some_and(|location| Cache::open(location).is_ok_and(|cache| cache.is_some()))
}
