//! Names that what is under way in this process has taken.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Names that are taken.
pub(super) struct Taken {
    /// Files that were written.
    pub(super) files: BTreeSet<PathBuf>,
    /// Folders into which runs write.
    pub(super) folders: BTreeSet<PathBuf>,
}

static TAKEN: Mutex<Taken> = Mutex::new(Taken { files: BTreeSet::new(), folders: BTreeSet::new() });

pub(super) fn taken() -> MutexGuard<'static, Taken> {
    TAKEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Name that all ways to a file share, where its folder exists.
pub(super) fn one_name(place: &Path) -> PathBuf {
    let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match (std::fs::canonicalize(place), std::fs::canonicalize(folder), place.file_name()) {
        (Ok(whole), _, _) => whole,
        (_, Ok(folder), Some(name)) => folder.join(name),
        _ => place.to_owned(),
    }
}
