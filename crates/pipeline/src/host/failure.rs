//! Failure of work: a sentence that says why, and of what kind it is.

use artifact::ArtifactError;
use artifact::bounded::ReadFault;
use artifact::sentence::readable;
use std::path::Path;

/// The sentence was made by the error it came from; what a program makes of its kind is the program's.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// An input was read and refused, or a check of `ci` failed.
    #[error("{}", readable(.0))]
    Refused(String),
    /// The content of a file cannot be worked on; which file that was is known further out.
    #[error("{}", readable(.0))]
    Unplaced(String),
    /// A file is missing, unreadable or unwritable, the disk is full, or the words of the command are off.
    #[error("{}", readable(.0))]
    System(String),
    /// Whoever asked for the work called it off.
    #[error("called off; whole frames and aspects are kept, the next run goes on from there")]
    CalledOff,
}

impl Failure {
    /// A refusal in the words of a stage, which knows no files.
    pub fn refused(error: impl std::fmt::Display) -> Self {
        Self::Unplaced(error.to_string())
    }

    /// Names the file that was read, where none is named yet.
    pub fn about(self, file: &Path) -> Self {
        match self {
            Self::Unplaced(text) => Self::Refused(format!("{}: {text}", file.display())),
            placed => placed,
        }
    }

    /// Names the file that names the one which is refused.
    pub fn named_in(self, file: &Path) -> Self {
        let named = |text: String| format!("{}: {text}", file.display());
        match self {
            Self::Refused(text) | Self::Unplaced(text) => Self::Refused(named(text)),
            Self::System(text) => Self::System(named(text)),
            Self::CalledOff => Self::CalledOff,
        }
    }

    /// An input was not read whole: the system's fault, or its own.
    pub fn unread(file: &Path, fault: &ReadFault) -> Self {
        let text = format!("{}: {fault}", file.display());
        if fault.is_system() { Self::System(text) } else { Self::Refused(text) }
    }

    /// Failure with what the system answered about `file`.
    pub fn system(file: &Path, doing: &str, error: impl std::fmt::Display) -> Self {
        Self::System(format!("{}: cannot {doing}: {error}", file.display()))
    }
}

impl From<ArtifactError> for Failure {
    fn from(error: ArtifactError) -> Self {
        if error.is_system() { Self::System(error.to_string()) } else { Self::Refused(error.to_string()) }
    }
}
