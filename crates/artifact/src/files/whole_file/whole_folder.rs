//! A folder that is there whole, under its name, or not at all.

use crate::files::fault::{ArtifactError, Fault};
use crate::files::place_rule::PlaceRule;
use crate::files::whole_file::temporary::TemporaryFolder;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// A folder that is filled beside its place under a name of its own, and renamed when all is there.
///
/// Two programs may fill one place at once: the first to finish has it, the other one is refused. Dropped
/// before [`WholeFolder::finish`], it leaves nothing; what a killed program left is removed by the next one
/// that writes beside it.
pub struct WholeFolder {
    place: PathBuf,
    temporary: TemporaryFolder,
}

impl WholeFolder {
    /// Begins to fill what becomes the folder `place`, which is not there yet, or empty; a symbolic link
    /// stands for the folder that it leads to.
    ///
    /// # Errors
    /// It holds something, is no folder, leads nowhere, or nothing can be written beside it.
    pub fn create(place: &Path) -> Result<Self, ArtifactError> {
        let made = behind_link(place).and_then(|target| {
            is_free(&target)?;
            Ok(Self { temporary: TemporaryFolder::beside(&target)?, place: target })
        });
        made.map_err(|fault| fault.of(place))
    }

    /// The place of the folder's files until it is finished.
    pub fn filled(&self) -> &Path {
        self.temporary.path()
    }

    /// Gives the folder its name.
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

/// The place itself, or what it leads to where it is a symbolic link.
fn behind_link(place: &Path) -> Result<PathBuf, Fault> {
    if !std::fs::symlink_metadata(place).is_ok_and(|about| about.is_symlink()) {
        return Ok(place.to_owned());
    }
    std::fs::canonicalize(place).map_err(|error| match error.kind() {
        ErrorKind::NotFound => Fault::Place(PlaceRule::DanglingLink),
        _ => Fault::system("follow the link")(error),
    })
}

/// Nothing stands there, or an empty folder.
fn is_free(place: &Path) -> Result<(), Fault> {
    if place.file_name().is_none() {
        return Err(Fault::Place(PlaceRule::Nameless));
    }
    match std::fs::read_dir(place).map(Iterator::count) {
        Ok(0) => Ok(()),
        Ok(_) => Err(Fault::Place(PlaceRule::Filled)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        Err(error) => Err(Fault::system("make the folder")(error)),
    }
}
