//! Rules for the place of an output file.

use std::path::{Path, PathBuf};

/// Reason that a file may not be placed at the requested path.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum OutputPathFault {
    /// The path does not end in a name.
    #[error("it names no file")]
    Nameless,
    /// A folder has that name.
    #[error("it is a folder")]
    Folder,
    /// A device, a FIFO or a socket has that name; replacing it by a file would remove it for all its users.
    #[error("it is {0}, and only plain files are replaced")]
    Special(&'static str),
    /// A dangling symbolic link: its intended target is not known to be a plain file.
    #[error("it is a symbolic link to nothing; remove it, or make the file that it leads to")]
    DanglingLink,
    /// The place of a folder that is written as a whole is not empty, or is no folder.
    #[error("it is not empty, and is filled as a whole: choose a folder of its own")]
    Filled,
    /// The owner has write-protected the existing file.
    #[error("it is write-protected")]
    WriteProtected,
    /// The output would destroy an input that it is made from.
    #[error("it is an input of this command{}", name_of(.input, .place))]
    Input {
        /// Path requested for the output.
        place: PathBuf,
        /// Name by which the input was read.
        input: PathBuf,
    },
}

/// The input's other name, where it differs from the requested place.
fn name_of(input: &Path, place: &Path) -> String {
    if input == place { String::new() } else { format!(", `{}`", input.display()) }
}
