//! Temporary files and folders: named so that they are known again, locked as long as their writer lives.
//!
//! A program that is killed leaves them behind and loses its locks. The next one that writes into the folder
//! removes those that nobody holds; those of a program that still runs it cannot lock, and leaves alone. On
//! file systems without locks nothing is removed. Locks of another machine may not be seen where a folder is
//! shared over a network: the name tells the machine, and another one's file is removed only when nothing was
//! written to it for a day. What another machine's folder holds may be written to without a trace on the
//! folder, so it stays.

use crate::files::fault::Fault;
use std::collections::BTreeSet;
use std::fs::{File, Metadata, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, SystemTime};
use tempfile::{TempDir, TempPath};

/// Ending of a temporary file's name; before it stand a dot, the name that the file will have, a dot, the
/// machine, a dot and six random letters.
const SUFFIX: &str = ".wayside.part";

/// Bytes of the later name that go into the temporary one: names end at 255 bytes on most file systems.
const NAME_BYTES: usize = 200;

/// Letters that tell a machine.
const MACHINE_LETTERS: usize = 8;

/// After so long without a byte, the writer on another machine is taken for dead: a writer of this program
/// writes every few minutes.
const SILENCE: Duration = Duration::from_secs(24 * 3600);

/// A name is taken from a sweeper that met the file between its making and its locking; a second time is
/// chance.
const ATTEMPTS: usize = 16;

/// A temporary file that is listed while it is open, and removed unless it is persisted.
pub(super) struct Temporary(Option<TempPath>);

impl Temporary {
    /// Makes a temporary file in the folder of `target`, which is made where it is missing.
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
    /// The file goes while it is held, as in [`Temporary::persist`].
    fn drop(&mut self) {
        if let Some(path) = self.0.take() {
            let mut open = open_files();
            open.remove::<Path>(&path);
            drop(path);
        }
    }
}

/// A folder that is filled under a temporary name, and removed with all it holds unless it is persisted.
pub(super) struct TemporaryFolder {
    /// Held while the folder is filled; some systems open no folder and so lock none.
    _lock: Option<File>,
    folder: Option<TempDir>,
}

impl TemporaryFolder {
    /// Makes a temporary folder beside `target`; folders above it are made where they are missing.
    pub(super) fn beside(target: &Path) -> Result<Self, Fault> {
        let mut open = open_files();
        let above = folder_of(target)?;
        let (lock, folder) = locked_folder(above, &prefix(target)).map_err(Fault::system("create"))?;
        open.insert(folder.path().to_path_buf());
        Ok(Self { _lock: lock, folder: Some(folder) })
    }

    /// The place of the folder until it is persisted.
    pub(super) fn path(&self) -> &Path {
        self.folder.as_ref().map_or(Path::new(""), TempDir::path)
    }

    /// Gives the folder its name, which nothing may bear but an empty folder.
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
    /// The folder goes while it is held, with all in it.
    fn drop(&mut self) {
        if let Some(folder) = self.folder.take() {
            let mut open = open_files();
            open.remove(folder.path());
            drop(folder);
        }
    }
}

/// The folder in which a temporary one is made, swept once.
fn folder_of(target: &Path) -> Result<&Path, Fault> {
    let folder = target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(Fault::system("make the folder"))?;
    sweep_once(folder);
    Ok(folder)
}

/// Removes the temporary files and folders that dead writers have left in a folder, not below it, and returns
/// their number.
pub fn sweep(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    entries.filter(|file| is_temporary(file) && remove_if_abandoned(file)).count()
}

/// Whether a name is one that only temporary files and folders have.
pub fn is_temporary(file: &Path) -> bool {
    let name = file.file_name().and_then(|name| name.to_str()).and_then(|name| name.strip_suffix(SUFFIX));
    name.is_some_and(|name| name.starts_with('.'))
}

/// Removes the temporary files and folders of all that is being written: the last act of a program that is
/// told to stop. As long as what it hands out is held, other threads make no new ones and put none in place:
/// hold it until the program has ended.
pub fn abandon_all() -> Abandoned {
    let open = open_files();
    for place in open.iter() {
        let _ = remove(place);
    }
    Abandoned { _open: open }
}

/// Hold on everything that writes files: whoever wants to begin or to finish one waits until it is dropped.
#[must_use = "what other threads make before the program ends would be left behind"]
pub struct Abandoned {
    _open: MutexGuard<'static, BTreeSet<PathBuf>>,
}

/// Removes a file, or a folder with all it holds; a link is not followed.
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

/// Folders that this program has swept.
static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn sweep_once(folder: &Path) {
    if SWEPT.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.to_owned()) {
        sweep(folder);
    }
}

/// Removes a temporary file or folder while it is locked, so that no writer can take it up; a link is not
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

/// Whether nothing was written for long; a clock that runs ahead here is off by minutes.
fn is_silent(about: &Metadata) -> bool {
    let age = about.modified().ok().and_then(|last| SystemTime::now().duration_since(last).ok());
    age.is_some_and(|age| age > SILENCE)
}

/// Letters for the running kernel, which all programs share whose locks are seen by each other, containers of
/// one machine too; systems that do not tell it count as one machine.
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

/// Names of temporary files and folders, with these permissions less the umask, as anything new.
fn named(prefix: &str, mode: u32) -> tempfile::Builder<'_, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(prefix).suffix(SUFFIX);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(mode));
    #[cfg(not(unix))]
    let _ = mode;
    builder
}

/// Locks what was just made, and whether it is still there: a sweeper may have met it before the lock.
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
