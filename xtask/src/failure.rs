//! How a command ends when it does not succeed.

use artifact::ArtifactError;
use std::path::Path;
use std::process::ExitCode;

/// The sentence was made by the error it came from; here it only gets its exit code.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// An input was read and refused, or a check of `ci` failed.
    #[error("{0}")]
    Refused(String),
    /// A file is missing, unreadable or unwritable, the disk is full, or the words of the command are off.
    #[error("{0}")]
    System(String),
}

impl Failure {
    /// Prints the sentence on standard error; exit code 1 or 2.
    pub(crate) fn report(&self) -> ExitCode {
        crate::progress::finish();
        crate::output::say(format_args!("error: {self}"));
        match self {
            Self::Refused(_) => ExitCode::from(1),
            Self::System(_) => ExitCode::from(2),
        }
    }

    /// A refusal in the words of `error`.
    pub(crate) fn refused(error: impl std::fmt::Display) -> Self {
        Self::Refused(error.to_string())
    }

    /// What the system answered about `file`.
    pub(crate) fn system(file: &Path, doing: &str, error: impl std::fmt::Display) -> Self {
        Self::System(format!("{}: cannot {doing}: {error}", file.display()))
    }
}

impl From<ArtifactError> for Failure {
    fn from(error: ArtifactError) -> Self {
        if error.is_system() { Self::System(error.to_string()) } else { Self::Refused(error.to_string()) }
    }
}
