//! A folder that appears under its name complete or not at all.

use crate::files::atomic_file::temporary::TemporaryFolder;
use crate::files::fault::{ArtifactError, Fault};
use crate::files::output_path::OutputPathFault;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// A folder filled under a temporary name beside its destination, and renamed when complete.
///
/// Two programs may fill one destination at once: the first to finish obtains it, the other is refused. If
/// dropped before [`AtomicFolder::finish`], it leaves nothing; leftovers of a killed program are removed by
/// the next one that writes beside it.
pub struct AtomicFolder {
    place: PathBuf,
    temporary: TemporaryFolder,
}

impl AtomicFolder {
    /// Starts filling the future folder `place`, which must be absent or empty; a symbolic link stands for
    /// the folder that it points to.
    ///
    /// # Errors
    /// The place is not empty, is no folder, is a dangling link, or nothing can be written beside it.
    pub fn create(place: &Path) -> Result<Self, ArtifactError> {
        let made = behind_link(place).and_then(|target| {
            is_free(&target)?;
            Ok(Self { temporary: TemporaryFolder::beside(&target)?, place: target })
        });
        made.map_err(|fault| fault.of(place))
    }

    /// Path of the folder's files until it is finished.
    pub fn path(&self) -> &Path {
        self.temporary.path()
    }

    /// Renames the folder to its destination.
    ///
    /// # Errors
    /// Another program has put something there meanwhile, or the system refuses.
    pub fn finish(self) -> Result<(), ArtifactError> {
        let Self { place, temporary } = self;
        let put = is_free(&place)
            .and_then(|()| temporary.persist(&place).map_err(Fault::system("rename into place")));
        put.map_err(|fault| fault.of(&place))
    }
}

/// The place itself, or the target of the symbolic link there.
fn behind_link(place: &Path) -> Result<PathBuf, Fault> {
    if !std::fs::symlink_metadata(place).is_ok_and(|about| about.is_symlink()) {
        return Ok(place.to_owned());
    }
    std::fs::canonicalize(place).map_err(|error| match error.kind() {
        ErrorKind::NotFound => Fault::Place(OutputPathFault::DanglingLink),
        _ => Fault::system("follow the link")(error),
    })
}

/// Checks that the place is absent or an empty folder.
fn is_free(place: &Path) -> Result<(), Fault> {
    if place.file_name().is_none() {
        return Err(Fault::Place(OutputPathFault::Nameless));
    }
    match std::fs::read_dir(place).map(Iterator::count) {
        Ok(0) => Ok(()),
        Ok(_) => Err(Fault::Place(OutputPathFault::Filled)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        Err(error) => Err(Fault::system("make the folder")(error)),
    }
}
