//! Names claimed by the commands under way in this process.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Claimed names.
pub(super) struct ClaimedPaths {
    /// Files that were written.
    pub(super) files: BTreeSet<PathBuf>,
    /// Folders that runs write into.
    pub(super) folders: BTreeSet<PathBuf>,
}

static CLAIMED: Mutex<ClaimedPaths> =
    Mutex::new(ClaimedPaths { files: BTreeSet::new(), folders: BTreeSet::new() });

pub(super) fn claimed_paths() -> MutexGuard<'static, ClaimedPaths> {
    CLAIMED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Canonical name of a file, if its folder exists.
pub(super) fn canonical_name(place: &Path) -> PathBuf {
    let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match (std::fs::canonicalize(place), std::fs::canonicalize(folder), place.file_name()) {
        (Ok(whole), _, _) => whole,
        (_, Ok(folder), Some(name)) => folder.join(name),
        _ => place.to_owned(),
    }
}
