//! Registry of the files that this program reads as inputs: no output may replace one of them.
//!
//! Every user file is opened for reading here, so that [`atomic_file`](crate::files::atomic_file) recognises
//! it by any name: a hard link, a symbolic link or another path to the same folder. Anything but a plain file
//! (a FIFO, a device, a socket, a folder) is refused before it is opened, since opening a FIFO waits for its
//! writer and reading a device may never end.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{File, FileType, Metadata};
use std::io::{self, Read, Result};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Opens a plain file for reading and registers it as an input, which no output may replace; the caller
/// bounds the length read.
///
/// # Errors
/// The system's, and [`io::ErrorKind::InvalidInput`] if it is no plain file.
pub fn open(file: &Path) -> Result<File> {
    check_plain(std::fs::metadata(file)?.file_type())?;
    let handle = File::open(file)?;
    check_plain(handle.metadata()?.file_type())?;
    register(file, &handle)?;
    Ok(handle)
}

/// Registers a file that is open for reading.
pub fn register(file: &Path, handle: &File) -> Result<()> {
    insert(file, &handle.metadata()?);
    Ok(())
}

/// Registers a file that will be read later; a missing one is left to its reader to report.
pub fn register_path(file: &Path) {
    if let Ok(about) = std::fs::metadata(file) {
        insert(file, &about);
    }
}

/// Name of a plain file and BLAKE3 hash of its content, as stored in
/// [`Provenance::inputs`](crate::Provenance::inputs).
///
/// The file is read in pieces, since a recording may be larger than memory.
///
/// # Errors
/// The file is unreadable, not plain, or endless: files of `/proc` are plain, and some never end.
pub fn named_hash(file: &Path) -> Result<(String, String)> {
    let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut hasher = blake3::Hasher::new();
    let handle = open(file)?;
    let told_bytes = handle.metadata()?.len();
    let most_bytes = told_bytes.saturating_add(GROWTH_LIMIT_BYTES);
    if io::copy(&mut handle.take(most_bytes), &mut hasher)? == most_bytes {
        let text = format!("it goes on far beyond the {told_bytes} bytes that the system tells of");
        return Err(io::Error::new(io::ErrorKind::InvalidData, text));
    }
    Ok((name, hasher.finalize().to_hex().to_string()))
}

/// Bytes that a file may have beyond its reported length, since more may be appended meanwhile.
const GROWTH_LIMIT_BYTES: u64 = 256 << 20;

/// Name by which the file with the metadata `about` was read, if it is an input.
pub(crate) fn registered_name(file: &Path, about: &Metadata) -> Option<PathBuf> {
    let asked = identity(file, about)?;
    let inputs = registry().get(&asked)?.clone();
    // The number of a deleted input may have been reused for another file.
    let still_exists = |input: &PathBuf| {
        std::fs::metadata(input).is_ok_and(|now| identity(input, &now).as_ref() == Some(&asked))
    };
    inputs.into_iter().find(still_exists)
}

/// Identity of a file, independent of its name.
#[cfg(unix)]
type Identity = (u64, u64);
#[cfg(not(unix))]
type Identity = PathBuf;

/// Files with the names by which they were read.
type Registry = BTreeMap<Identity, BTreeSet<PathBuf>>;

static REGISTRY: Mutex<Registry> = Mutex::new(BTreeMap::new());

fn registry() -> MutexGuard<'static, Registry> {
    REGISTRY.lock().unwrap_or_else(PoisonError::into_inner)
}

fn insert(file: &Path, about: &Metadata) {
    if let Some(identity) = identity(file, about) {
        registry().entry(identity).or_default().insert(file.to_owned());
    }
}

/// Device and number of the file.
#[cfg(unix)]
fn identity(_: &Path, about: &Metadata) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt;
    Some((about.dev(), about.ino()))
}

#[cfg(not(unix))]
fn identity(file: &Path, _: &Metadata) -> Option<Identity> {
    std::fs::canonicalize(file).ok()
}

fn check_plain(kind: FileType) -> Result<()> {
    match kind {
        kind if kind.is_file() => Ok(()),
        kind if kind.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        kind => {
            let text = format!("it is {}, and plain files alone are read", kind_name(kind));
            Err(io::Error::new(io::ErrorKind::InvalidInput, text))
        }
    }
}

#[cfg(unix)]
fn kind_name(kind: FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    match kind {
        kind if kind.is_fifo() => "a FIFO",
        kind if kind.is_socket() => "a socket",
        kind if kind.is_char_device() || kind.is_block_device() => "a device",
        _ => "something else",
    }
}

#[cfg(not(unix))]
fn kind_name(_: FileType) -> &'static str {
    "something else"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(target_os = "linux")]
    #[test]
    fn a_file_without_an_end_is_not_hashed_for_ever() {
        let endless = Path::new("/proc/self/pagemap");
        if endless.is_file() {
            let error = named_hash(endless).unwrap_err();
            assert!(error.to_string().contains("beyond the 0 bytes"), "{error}");
        }
    }
}
