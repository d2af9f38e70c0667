//! A file that is written whole or not at all: first a temporary file beside it, renamed when complete.
//!
//! All output of this program is written here, so that the same rules hold everywhere: only plain files are
//! replaced, and neither an input ([`inputs`](crate::files::inputs)) nor a write-protected file (the
//! `destination`); leftovers of a killed program are removed by the next one that writes into the same folder
//! (the `temporary`).

mod destination;
mod temporary;
mod atomic_folder;

pub use crate::files::output_path::OutputPathFault;
pub use atomic_folder::AtomicFolder;
pub use temporary::{TemporaryFileBlock, is_temporary, remove_all_temporaries, remove_stale};

use crate::files::fault::{ArtifactError, Fault};
use destination::Destination;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use temporary::Temporary;

/// A stream to a temporary file; [`AtomicFile::finish`] renames it to its destination.
///
/// If dropped before `finish`, it leaves nothing behind and an older file of that name untouched.
pub struct AtomicFile {
    place: PathBuf,
    target: PathBuf,
    stream: BufWriter<File>,
    temporary: Temporary,
}

/// Whether a finished file survives a loss of power.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Durability {
    /// Finishing waits for the disk.
    OnDisk,
    /// Durability as provided by the system's write-back: sufficient for files that can be made again.
    InCache,
}

impl AtomicFile {
    /// Opens the stream; missing folders are created. A symbolic link to a plain file stays, its target is
    /// replaced.
    pub fn create(place: &Path) -> Result<Self, ArtifactError> {
        Self::open(place).map_err(|fault| fault.of(place))
    }

    fn open(place: &Path) -> Result<Self, Fault> {
        let Destination { target, permissions } = Destination::of(place)?;
        let (handle, temporary) = Temporary::beside(&target)?;
        if let Some(permissions) = permissions {
            handle.set_permissions(permissions).map_err(Fault::system("set the permissions"))?;
        }
        Ok(Self { place: place.to_owned(), target, stream: BufWriter::new(handle), temporary })
    }

    /// Renames the file to its destination.
    pub fn finish(self, durability: Durability) -> Result<(), ArtifactError> {
        let place = self.place.clone();
        self.put(durability).map_err(|fault| fault.of(&place))
    }

    /// Renames the file; the handle, and with it the lock, is held until then.
    fn put(self, durability: Durability) -> Result<(), Fault> {
        let handle = self.stream.into_inner().map_err(|e| Fault::system("write")(e.into_error()))?;
        match durability {
            Durability::OnDisk => handle.sync_all().map_err(Fault::system("write"))?,
            Durability::InCache => {}
        }
        // Inputs may have been opened meanwhile, and the destination may have changed.
        Destination::of(&self.target)?;
        self.temporary.persist(&self.target).map_err(Fault::system("rename into place"))
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.stream.write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.stream.flush()
    }
}

/// Writes a file whole or not at all.
pub fn write(place: &Path, bytes: &[u8], durability: Durability) -> Result<(), ArtifactError> {
    let mut file = AtomicFile::create(place)?;
    file.write_all(bytes).map_err(|e| Fault::system("write")(e).of(place))?;
    file.finish(durability)
}

/// Checks before the work is done that its result can be written: returns all that [`AtomicFile::create`]
/// would refuse. Missing folders are created.
pub fn check(place: &Path) -> Result<(), ArtifactError> {
    AtomicFile::create(place).map(drop)
}
