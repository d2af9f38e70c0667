//! Mark that distinguishes a cache from other folders: `CACHEDIR.TAG`, which backup programs know too.
//!
//! A folder without the mark is a cache only if it is missing, empty, or holds nothing but files with names
//! of a cache: caches of earlier versions have no mark and hold nothing else. It gets its mark with the next
//! file. Every other folder is refused, so that a mistyped `--cache` never mixes entries into a user's files.

use crate::chain::cache::cache_files::{self, MARK};
use crate::host::failure::Failure;
use artifact::ArtifactError;
use artifact::atomic_file::{self, Durability};
use std::io::{ErrorKind, Read};
use std::path::Path;

/// Beginning of the mark as the standard requires (<https://bford.info/cachedir/>).
const SIGNATURE: &str = "Signature: 8a477f597d28d172789f06886806bc55";

const REST: &str = "\n# Frames that Wayside keeps; all of them can be made again.\n# For information about cache directory tags, see https://bford.info/cachedir/\n";

/// Refuses a folder that is no cache.
pub(super) fn check(root: &Path) -> Result<(), Failure> {
    match std::fs::metadata(root) {
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(()),
        Err(e) => return Err(Failure::system(root, "look at", e)),
        Ok(about) if !about.is_dir() => return Err(refused(root, "it is no folder")),
        Ok(_) => {}
    }
    if is_set(root) {
        return Ok(());
    }
    std::fs::read_dir(root).map_err(|e| Failure::system(root, "read", e))?;
    match cache_files::list(root).foreign {
        None => Ok(()),
        Some(foreign) => {
            let foreign = foreign.strip_prefix(root).unwrap_or(&foreign);
            Err(refused(root, &format!("it has no {MARK}, and no cache holds `{}`", foreign.display())))
        }
    }
}

fn refused(root: &Path, why: &str) -> Failure {
    Failure::System(format!(
        "{}: is no cache: {why}; --cache takes a cache, or a new or empty folder",
        root.display()
    ))
}

/// Whether the mark exists: a plain file that begins with the signature.
fn is_set(root: &Path) -> bool {
    let place = root.join(MARK);
    let is_plain = std::fs::symlink_metadata(&place).is_ok_and(|about| about.is_file());
    let mut begin = [0; SIGNATURE.len()];
    let read = |begin: &mut [u8]| std::fs::File::open(&place).and_then(|mut file| file.read_exact(begin));
    is_plain && read(&mut begin).is_ok() && begin == SIGNATURE.as_bytes()
}

/// Creates the folder where it is missing, and marks it.
pub(super) fn set(root: &Path) -> Result<(), ArtifactError> {
    if is_set(root) {
        return Ok(());
    }
    atomic_file::write(&root.join(MARK), format!("{SIGNATURE}{REST}").as_bytes(), Durability::InCache)
}
