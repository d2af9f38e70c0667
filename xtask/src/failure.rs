//! How a command ends when it does not succeed.

use artifact::ArtifactError;
use artifact::bounded::ReadFault;
use std::path::Path;
use std::process::ExitCode;

/// The sentence was made by the error it came from; here it only gets its exit code.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// An input was read and refused, or a check of `ci` failed.
    #[error("{0}")]
    Refused(String),
    /// What was read of a file cannot be worked on; which file that was is known further out.
    #[error("{0}")]
    Unplaced(String),
    /// A file is missing, unreadable or unwritable, the disk is full, or the words of the command are off.
    #[error("{0}")]
    System(String),
}

impl Failure {
    /// Prints the sentence on standard error; exit code 1 or 2.
    pub(crate) fn report(&self) -> ExitCode {
        crate::progress::finish();
        crate::output::say(format_args!("error: {}", printable(&self.to_string())));
        match self {
            Self::Refused(_) | Self::Unplaced(_) => ExitCode::from(1),
            Self::System(_) => ExitCode::from(2),
        }
    }

    /// A refusal in the words of a stage, which knows no files.
    pub(crate) fn refused(error: impl std::fmt::Display) -> Self {
        Self::Unplaced(error.to_string())
    }

    /// With the file that was read, where none is named yet.
    pub(crate) fn about(self, file: &Path) -> Self {
        match self {
            Self::Unplaced(text) => Self::Refused(format!("{}: {text}", file.display())),
            placed => placed,
        }
    }

    /// An input was not read whole: the system's fault, or its own.
    pub(crate) fn unread(file: &Path, fault: &ReadFault) -> Self {
        let text = format!("{}: {fault}", file.display());
        if fault.is_system() { Self::System(text) } else { Self::Refused(text) }
    }

    /// What the system answered about `file`.
    pub(crate) fn system(file: &Path, doing: &str, error: impl std::fmt::Display) -> Self {
        Self::System(format!("{}: cannot {doing}: {error}", file.display()))
    }
}

/// What a file says, as a terminal may show it: no signs that move its cursor, and of a line no more than a screen full.
fn printable(text: &str) -> String {
    const SHOWN: usize = 2000;
    let line = |line: &str| {
        let mut shown: String = line.chars().take(SHOWN).flat_map(visible).collect();
        if line.chars().nth(SHOWN).is_some() {
            shown.push('…');
        }
        shown
    };
    text.split('\n').map(line).collect::<Vec<_>>().join("\n")
}

/// A sign as it is, a control as its escape.
fn visible(sign: char) -> impl Iterator<Item = char> {
    let reorders = matches!(sign, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let hidden = (sign.is_control() && sign != '\t') || reorders;
    let escape = hidden.then(|| sign.escape_default());
    escape.into_iter().flatten().chain((!hidden).then_some(sign))
}

impl From<ArtifactError> for Failure {
    fn from(error: ArtifactError) -> Self {
        if error.is_system() { Self::System(error.to_string()) } else { Self::Refused(error.to_string()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_says_does_not_move_the_cursor_nor_fill_the_terminal() {
        assert_eq!(
            printable("a.toml:1:1: no `\u{1b}[2Jé\t\u{202e}`\nmore"),
            "a.toml:1:1: no `\\u{1b}[2Jé\t\\u{202e}`\nmore"
        );
        let long = printable(&"x".repeat(1 << 20));
        assert_eq!(long.chars().count(), 2001);
    }
}
