//! Temporary files and folders, recognisable by name and locked while their writer lives.
//!
//! A killed program leaves them behind and loses its locks. The next program that writes into the folder
//! removes those that are not locked, and leaves alone those of a running program, which it cannot lock. On
//! file systems without locks nothing is removed. On a network share, locks of another machine may be
//! invisible: the name therefore identifies the machine, and another machine's file is removed only after a
//! day without writes. Another machine's folder stays, since writes to its contents may leave no trace on the
//! folder itself.

use crate::files::fault::Fault;
use std::collections::BTreeSet;
use std::fs::{File, Metadata, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, SystemTime};
use tempfile::{TempDir, TempPath};

/// Suffix of a temporary file's name, which is: a dot, the final name, a dot, the machine, a dot, six random
/// letters, this suffix.
const SUFFIX: &str = ".wayside.part";

/// Bytes of the final name used in the temporary one: names are limited to 255 bytes on most file systems.
const NAME_BYTES: usize = 200;

/// Number of letters that identify a machine.
const MACHINE_LETTERS: usize = 8;

/// Time without a write after which a writer on another machine is taken for dead: this program writes every
/// few minutes.
const SILENCE: Duration = Duration::from_secs(24 * 3600);

/// Attempts to make a temporary file: a sweeper may remove one between its creation and its locking, a second
/// time only by chance.
const ATTEMPTS: usize = 16;

/// A temporary file, listed while it is open and removed unless it is persisted.
pub(super) struct Temporary(Option<TempPath>);

impl Temporary {
    /// Creates a temporary file in the folder of `target`, and that folder if it is missing.
    pub(super) fn beside(target: &Path) -> Result<(File, Self), Fault> {
        let mut open = open_files(); // before it is made: what is there is listed
        let (handle, path) = locked(folder_of(target)?, &prefix(target)).map_err(Fault::system("create"))?;
        open.insert(path.to_path_buf());
        Ok((handle, Self(Some(path))))
    }

    pub(super) fn persist(mut self, target: &Path) -> std::io::Result<()> {
        match self.0.take() {
            Some(path) => {
                let mut open = open_files();
                open.remove::<Path>(&path);
                path.persist(target).map_err(|e| e.error)
            }
            None => Ok(()),
        }
    }
}

impl Drop for Temporary {
    /// Removes the file while the list is locked, as in [`Temporary::persist`].
    fn drop(&mut self) {
        if let Some(path) = self.0.take() {
            let mut open = open_files();
            open.remove::<Path>(&path);
            drop(path);
        }
    }
}

/// A folder filled under a temporary name, and removed with its contents unless it is persisted.
pub(super) struct TemporaryFolder {
    /// Lock held while the folder is filled; some systems cannot open, and so not lock, a folder.
    _lock: Option<File>,
    folder: Option<TempDir>,
}

impl TemporaryFolder {
    /// Creates a temporary folder beside `target`, and missing parent folders.
    pub(super) fn beside(target: &Path) -> Result<Self, Fault> {
        let mut open = open_files();
        let above = folder_of(target)?;
        let (lock, folder) = locked_folder(above, &prefix(target)).map_err(Fault::system("create"))?;
        open.insert(folder.path().to_path_buf());
        Ok(Self { _lock: lock, folder: Some(folder) })
    }

    /// Path of the folder until it is persisted.
    pub(super) fn path(&self) -> &Path {
        self.folder.as_ref().map_or(Path::new(""), TempDir::path)
    }

    /// Renames the folder to `target`, where nothing but an empty folder may exist.
    pub(super) fn persist(mut self, target: &Path) -> std::io::Result<()> {
        let mut open = open_files();
        let _ = std::fs::remove_dir(target); // an empty one; of anything else it takes nothing
        std::fs::rename(self.path(), target)?;
        if let Some(folder) = self.folder.take() {
            open.remove(&folder.keep());
        }
        Ok(())
    }
}

impl Drop for TemporaryFolder {
    /// Removes the folder and its contents while the list is locked.
    fn drop(&mut self) {
        if let Some(folder) = self.folder.take() {
            let mut open = open_files();
            open.remove(folder.path());
            drop(folder);
        }
    }
}

/// Folder for a temporary file, cleaned of stale ones once per program.
fn folder_of(target: &Path) -> Result<&Path, Fault> {
    let folder = target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(Fault::system("make the folder"))?;
    remove_stale_once(folder);
    Ok(folder)
}

/// Removes the temporary files and folders that dead writers left directly in a folder; returns their number.
pub fn remove_stale(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    entries.filter(|file| is_temporary(file) && remove_if_abandoned(file)).count()
}

/// Whether a name has the form of a temporary file or folder.
pub fn is_temporary(file: &Path) -> bool {
    let name = file.file_name().and_then(|name| name.to_str()).and_then(|name| name.strip_suffix(SUFFIX));
    name.is_some_and(|name| name.starts_with('.'))
}

/// Removes all temporary files and folders of this program, as its last act when it is told to stop. While
/// the returned guard is held, other threads can neither create nor persist any: hold it until the program
/// has ended.
pub fn remove_all_temporaries() -> TemporaryFileBlock {
    let open = open_files();
    for place in open.iter() {
        let _ = remove(place);
    }
    TemporaryFileBlock { _open: open }
}

/// Guard that blocks all creation and completion of files until it is dropped.
#[must_use = "what other threads make before the program ends would be left behind"]
pub struct TemporaryFileBlock {
    _open: MutexGuard<'static, BTreeSet<PathBuf>>,
}

/// Removes a file, or a folder with its contents; links are not followed.
fn remove(place: &Path) -> std::io::Result<()> {
    if std::fs::symlink_metadata(place)?.is_dir() {
        std::fs::remove_dir_all(place)
    } else {
        std::fs::remove_file(place)
    }
}

/// Temporary files and folders that are still open.
static OPEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn open_files() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    OPEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Folders that this program has cleaned of stale temporary files.
static CLEANED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn remove_stale_once(folder: &Path) {
    if CLEANED.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.to_owned()) {
        remove_stale(folder);
    }
}

/// Removes a temporary file or folder while holding its lock, so that no writer can take it up; links are not
/// followed.
fn remove_if_abandoned(place: &Path) -> bool {
    let Ok(about) = std::fs::symlink_metadata(place) else { return false };
    let is_plain = about.is_file() || about.is_dir();
    if !is_plain || !(is_of_this_machine(place) || about.is_file() && is_silent(&about)) {
        return false;
    }
    let Ok(handle) = File::open(place) else { return false };
    handle.try_lock().is_ok() && remove(place).is_ok()
}

fn is_of_this_machine(file: &Path) -> bool {
    let name = file.file_name().and_then(|name| name.to_str()).and_then(|name| name.strip_suffix(SUFFIX));
    name.and_then(|name| name.rsplit('.').nth(1)).is_some_and(|machine| machine == *MACHINE)
}

/// Whether the last write is long past; clock differences between machines are minutes.
fn is_silent(about: &Metadata) -> bool {
    let age = about.modified().ok().and_then(|last| SystemTime::now().duration_since(last).ok());
    age.is_some_and(|age| age > SILENCE)
}

/// Letters that identify the running kernel, common to all programs (containers included) that see each
/// other's locks; systems that do not provide it count as one machine.
static MACHINE: LazyLock<String> = LazyLock::new(|| {
    let told = std::fs::read_to_string("/proc/sys/kernel/random/boot_id").unwrap_or_default();
    blake3::hash(told.as_bytes()).to_hex()[..MACHINE_LETTERS].to_owned()
});

fn locked(folder: &Path, prefix: &str) -> std::io::Result<(File, TempPath)> {
    for _ in 0..ATTEMPTS {
        let (handle, path) = named(prefix, 0o666).tempfile_in(folder)?.into_parts();
        if is_own(&handle, &path) {
            return Ok((handle, path));
        }
    }
    Err(taken_away())
}

fn locked_folder(above: &Path, prefix: &str) -> std::io::Result<(Option<File>, TempDir)> {
    for _ in 0..ATTEMPTS {
        let folder = named(prefix, 0o777).tempdir_in(above)?;
        let Ok(handle) = File::open(folder.path()) else { return Ok((None, folder)) };
        if is_own(&handle, folder.path()) {
            return Ok((Some(handle), folder));
        }
    }
    Err(taken_away())
}

/// Builder of temporary names; new entries have the given permissions less the umask.
fn named(prefix: &str, mode: u32) -> tempfile::Builder<'_, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(prefix).suffix(SUFFIX);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(mode));
    #[cfg(not(unix))]
    let _ = mode;
    builder
}

/// Locks a new entry and tells whether it still exists: a sweeper may have removed it before the lock.
fn is_own(handle: &File, path: &Path) -> bool {
    !matches!(handle.try_lock(), Err(TryLockError::WouldBlock)) && is_named(handle, path)
}

fn taken_away() -> std::io::Error {
    std::io::Error::other("temporary files are removed as soon as they are made")
}

/// Whether the open file still has its name: a sweeper may have removed it before it was locked.
#[cfg(unix)]
fn is_named(handle: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let number = |about: std::io::Result<Metadata>| about.ok().map(|about| (about.dev(), about.ino()));
    let open = number(handle.metadata());
    open.is_some() && open == number(std::fs::symlink_metadata(path))
}

#[cfg(not(unix))]
fn is_named(_: &File, path: &Path) -> bool {
    path.exists()
}

fn prefix(target: &Path) -> String {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    let mut end = name.len().min(NAME_BYTES);
    while !name.is_char_boundary(end) {
        end -= 1;
    }
    format!(".{}.{}.", &name[..end], *MACHINE)
}
