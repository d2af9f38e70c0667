//! A file that is written whole or not at all: a temporary one beside its place, renamed when it is done.

use crate::envelope::{ArtifactError, Fault};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::{NamedTempFile, TempPath};

/// A stream to a temporary file; [`WholeFile::finish`] puts it in its place.
///
/// Dropped before `finish`, it leaves nothing behind and an older file of the name untouched.
pub struct WholeFile {
    place: PathBuf,
    stream: BufWriter<File>,
    temporary: Temporary,
}

/// Whether a finished file outlives a loss of power.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Durability {
    /// It waits for the disk.
    OnDisk,
    /// It is as durable as the system's own time table makes it: what can be made again.
    InCache,
}

impl WholeFile {
    /// Opens the stream; folders that are missing are made.
    pub fn create(place: &Path) -> Result<Self, ArtifactError> {
        let (handle, path) = temporary_beside(place).map_err(|fault| fault.of(place))?.into_parts();
        Ok(Self { place: place.to_owned(), stream: BufWriter::new(handle), temporary: Temporary::listed(path) })
    }

    /// Puts the file in its place.
    pub fn finish(self, durability: Durability) -> Result<(), ArtifactError> {
        let Self { place, stream, temporary } = self;
        let failed = |doing: &'static str| {
            let place = place.clone();
            move |e: std::io::Error| Fault::system(doing)(e).of(&place)
        };
        let handle = stream.into_inner().map_err(|e| failed("write")(e.into_error()))?;
        match durability {
            Durability::OnDisk => handle.sync_all().map_err(failed("write"))?,
            Durability::InCache => {}
        }
        temporary.persist(&place).map_err(failed("rename into place"))
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.stream.write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.stream.flush()
    }
}

/// Temporary files that are still open, for a program that is told to stop.
static OPEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn open_files() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    OPEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the temporary files of all that is being written: the last act of an interrupted program.
pub fn abandon_all() {
    for file in open_files().iter() {
        let _ = std::fs::remove_file(file);
    }
}

/// A temporary file that is listed while it is open, and removed unless it is persisted.
struct Temporary(Option<TempPath>);

impl Temporary {
    fn listed(path: TempPath) -> Self {
        open_files().insert(path.to_path_buf());
        Self(Some(path))
    }

    fn persist(mut self, place: &Path) -> std::io::Result<()> {
        match self.0.take() {
            Some(path) => {
                open_files().remove::<Path>(&path);
                path.persist(place).map_err(|e| e.error)
            }
            None => Ok(()),
        }
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(path) = &self.0 {
            open_files().remove::<Path>(path);
        }
    }
}

fn temporary_beside(file: &Path) -> Result<NamedTempFile, Fault> {
    let folder = file.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(Fault::system("make the folder"))?;
    let prefix = format!(".{}.", file.file_name().unwrap_or_default().to_string_lossy());
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".part");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666)); // less the umask, as any new file
    builder.tempfile_in(folder).map_err(Fault::system("create"))
}
