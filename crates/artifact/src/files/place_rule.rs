//! Rules that the place of a file can break.

use std::path::{Path, PathBuf};

/// Why a file may not be put where it was asked for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PlaceRule {
    /// The path ends in no name.
    #[error("it names no file")]
    Nameless,
    /// A folder has that name.
    #[error("it is a folder")]
    Folder,
    /// A device, a FIFO or a socket has that name: replaced by a file, it would be gone for all who use it.
    #[error("it is {0}, and only plain files are replaced")]
    Special(&'static str),
    /// A symbolic link that leads nowhere: what it is meant to lead to is not known to be a plain file.
    #[error("it is a symbolic link to nothing; remove it, or make the file that it leads to")]
    DanglingLink,
    /// Its owner has protected it.
    #[error("it is write-protected")]
    WriteProtected,
    /// It would destroy what it is made from.
    #[error("it is an input of this command{}", name_of(.input, .place))]
    Input {
        /// As it was asked for as an output.
        place: PathBuf,
        /// As it was read.
        input: PathBuf,
    },
}

/// The other name of an input.
fn name_of(input: &Path, place: &Path) -> String {
    if input == place { String::new() } else { format!(", `{}`", input.display()) }
}
