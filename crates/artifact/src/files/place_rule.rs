//! Rules that the place of a file can break.

use std::path::{Path, PathBuf};

/// Reason that a file may not be put where it was asked for.
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
    /// A folder that is filled as a whole holds something, or is no folder.
    #[error("it is not empty, and is filled as a whole: choose a folder of its own")]
    Filled,
    /// The owner has protected the file at that place.
    #[error("it is write-protected")]
    WriteProtected,
    /// The output would destroy an input that it is made from.
    #[error("it is an input of this command{}", name_of(.input, .place))]
    Input {
        /// Place that was asked for as an output.
        place: PathBuf,
        /// Name by which the input was read.
        input: PathBuf,
    },
}

/// The other name of an input.
fn name_of(input: &Path, place: &Path) -> String {
    if input == place { String::new() } else { format!(", `{}`", input.display()) }
}
