//! `cache`: lists the cached frames by stage, or removes all or the oldest of them.

use crate::program::cli::CacheCommandArguments;
use crate::program::terminal;
use pipeline::chain::cache::{Cache, NO_DEFAULT};
use pipeline::chain::stages::Stage;
use pipeline::host::failure::Failure;
use pipeline::host::memory::mib;

pub(crate) fn run(arguments: &CacheCommandArguments) -> Result<(), Failure> {
    let cache = Cache::open(&arguments.location.location())?
        .ok_or_else(|| Failure::System(format!("there is no cache: {NO_DEFAULT}")))?;
    if arguments.clear {
        cache.clear()?;
    }
    if arguments.location.cache_limit_mib.is_some() {
        cache.trim();
    }
    let files = cache.files();
    for stage in Stage::ALL {
        let folder = cache.root().join(stage.name());
        let own: Vec<_> = files.iter().filter(|file| file.path.starts_with(&folder)).collect();
        let bytes = own.iter().map(|file| file.bytes).sum();
        terminal::line(format!("{:<12}{:>8} files {:>10.1} MiB", stage.name(), own.len(), mib(bytes)));
    }
    let total = files.iter().map(|file| file.bytes).sum();
    let limit = arguments.location.location().limit_mib;
    terminal::line(format!(
        "{} holds {:.1} MiB; its limit is {limit} MiB",
        cache.root().display(),
        mib(total)
    ));
    Ok(())
}
