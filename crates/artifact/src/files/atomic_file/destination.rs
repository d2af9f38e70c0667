//! Permitted destinations of output files.

use crate::files::fault::Fault;
use crate::files::inputs;
use crate::files::output_path::OutputPathFault;
use std::fs::{FileType, Metadata, Permissions};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// A permitted destination of a file.
#[derive(Debug)]
pub(super) struct Destination {
    /// Path to write: the place itself, or the plain file that it links to.
    pub(super) target: PathBuf,
    /// Permissions of the file to be replaced.
    pub(super) permissions: Option<Permissions>,
}

impl Destination {
    /// Destination at `place`; refused if it is not a plain file, is an input, or is write-protected.
    pub(super) fn of(place: &Path) -> Result<Self, Fault> {
        if place.file_name().is_none() {
            return Err(Fault::Place(if place.is_dir() {
                OutputPathFault::Folder
            } else {
                OutputPathFault::Nameless
            }));
        }
        match std::fs::symlink_metadata(place) {
            Ok(about) if about.is_symlink() => Self::behind_link(place),
            Ok(about) => Self::replacing(place, place.to_owned(), &about),
            Err(e) if e.kind() == ErrorKind::NotFound => {
                Ok(Self { target: place.to_owned(), permissions: None })
            }
            Err(e) => Err(Fault::system("look at")(e)),
        }
    }

    fn behind_link(place: &Path) -> Result<Self, Fault> {
        let target = match std::fs::canonicalize(place) {
            Ok(target) => target,
            Err(e) if e.kind() == ErrorKind::NotFound => {
                return Err(Fault::Place(OutputPathFault::DanglingLink));
            }
            Err(e) => return Err(Fault::system("follow the link")(e)),
        };
        let about = std::fs::symlink_metadata(&target).map_err(Fault::system("look at"))?;
        Self::replacing(place, target, &about)
    }

    fn replacing(place: &Path, target: PathBuf, about: &Metadata) -> Result<Self, Fault> {
        let broken = match special(about.file_type()) {
            Some(rule) => Some(rule),
            None if about.permissions().readonly() => Some(OutputPathFault::WriteProtected),
            None => inputs::registered_name(&target, about)
                .map(|input| OutputPathFault::Input { place: place.to_owned(), input }),
        };
        match broken {
            Some(rule) => Err(Fault::Place(rule)),
            None => Ok(Self { target, permissions: Some(plain(about.permissions())) }),
        }
    }
}

/// Rule that a file of this type breaks; `None` for a plain file.
fn special(kind: FileType) -> Option<OutputPathFault> {
    if kind.is_file() {
        return None;
    }
    Some(if kind.is_dir() {
        OutputPathFault::Folder
    } else {
        OutputPathFault::Special(name_of_special(kind))
    })
}

#[cfg(unix)]
fn name_of_special(kind: FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    match () {
        () if kind.is_fifo() => "a FIFO",
        () if kind.is_socket() => "a socket",
        () => "a device",
    }
}

#[cfg(not(unix))]
fn name_of_special(_: FileType) -> &'static str {
    "no plain file"
}

/// Read, write and execute permissions only: set-user-ID bits are not passed on to data.
#[cfg(unix)]
fn plain(permissions: Permissions) -> Permissions {
    use std::os::unix::fs::PermissionsExt;
    Permissions::from_mode(permissions.mode() & 0o777)
}

#[cfg(not(unix))]
fn plain(permissions: Permissions) -> Permissions {
    permissions
}
