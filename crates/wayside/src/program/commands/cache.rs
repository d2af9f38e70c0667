//! `cache`: what is kept, by stage, and how to be rid of it.

use crate::chain::cache::Cache;
use crate::chain::stages::Stage;
use crate::host::failure::Failure;
use crate::host::memory::mib;
use crate::program::cli::CacheCommandArguments;
use crate::program::terminal;

pub(crate) fn run(arguments: &CacheCommandArguments) -> Result<(), Failure> {
    let cache = Cache::open(&arguments.location.location())?;
    if arguments.clear {
        cache.clear()?;
    }
    let files = cache.files();
    for stage in Stage::ALL {
        let folder = cache.root().join(stage.name());
        let own: Vec<_> = files.iter().filter(|file| file.path.starts_with(&folder)).collect();
        let bytes = own.iter().map(|file| file.bytes).sum();
        terminal::line(format!("{:<12}{:>8} files {:>10.1} MiB", stage.name(), own.len(), mib(bytes)));
    }
    let total = files.iter().map(|file| file.bytes).sum();
    let limit = arguments.location.cache_limit_mib;
    terminal::line(format!(
        "{} holds {:.1} MiB; its limit is {limit} MiB",
        cache.root().display(),
        mib(total)
    ));
    Ok(())
}
