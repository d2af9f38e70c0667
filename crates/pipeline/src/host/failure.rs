//! Failure of work: its kind, and a sentence with the reason.

use artifact::ArtifactError;
use artifact::bounded::ReadFault;
use artifact::message::truncated;
use std::path::Path;

/// The sentence comes from the causing error; the program decides how to treat each kind.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// An input was read and refused, or a check of `ci` failed.
    #[error("{}", truncated(.0))]
    Refused(String),
    /// The content of a file cannot be used; the caller knows which file.
    #[error("{}", truncated(.0))]
    Unplaced(String),
    /// A file is missing, unreadable or unwritable, the disk is full, or the command's arguments are wrong.
    #[error("{}", truncated(.0))]
    System(String),
    /// The caller cancelled the work.
    #[error("called off; whole frames and aspects are kept, the next run goes on from there")]
    Cancelled,
}

impl Failure {
    /// Refusal in the words of a stage, which does not know the file.
    pub fn refused(error: impl std::fmt::Display) -> Self {
        Self::Unplaced(error.to_string())
    }

    /// Adds the name of the file that was read, unless one is named already.
    pub fn about(self, file: &Path) -> Self {
        match self {
            Self::Unplaced(text) => Self::Refused(format!("{}: {text}", file.display())),
            placed => placed,
        }
    }

    /// Adds the name of the file that refers to the refused one.
    pub fn named_in(self, file: &Path) -> Self {
        let named = |text: String| format!("{}: {text}", file.display());
        match self {
            Self::Refused(text) | Self::Unplaced(text) => Self::Refused(named(text)),
            Self::System(text) => Self::System(named(text)),
            Self::Cancelled => Self::Cancelled,
        }
    }

    /// Failure to read an input to its end, due to the system or to the input itself.
    pub fn unread(file: &Path, fault: &ReadFault) -> Self {
        let text = format!("{}: {fault}", file.display());
        if fault.is_system() { Self::System(text) } else { Self::Refused(text) }
    }

    /// Failure with the system's error about `file`.
    pub fn system(file: &Path, doing: &str, error: impl std::fmt::Display) -> Self {
        Self::System(format!("{}: cannot {doing}: {error}", file.display()))
    }
}

impl From<ArtifactError> for Failure {
    fn from(error: ArtifactError) -> Self {
        if error.is_system() { Self::System(error.to_string()) } else { Self::Refused(error.to_string()) }
    }
}
