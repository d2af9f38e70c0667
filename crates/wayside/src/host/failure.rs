//! Failure of work: a sentence that says why, and of what kind it is.

use artifact::ArtifactError;
use artifact::bounded::ReadFault;
use std::borrow::Cow;
use std::path::Path;

/// Longest line of a sentence, in bytes: a list of all vehicles fits, a damaged file's word of megabytes not.
const LINE_BYTES: usize = 4096;
/// Bytes of a longer line that stay of its beginning and of its end, where file and rule stand.
const KEPT_BYTES: [usize; 2] = [3072, 512];

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

/// The sentence with what is too long for a reader left out of the middle of its lines.
fn readable(text: &str) -> Cow<'_, str> {
    if text.lines().all(|line| line.len() <= LINE_BYTES) {
        return text.into();
    }
    text.lines().map(readable_line).collect::<Vec<_>>().join("\n").into()
}

fn readable_line(line: &str) -> Cow<'_, str> {
    if line.len() <= LINE_BYTES {
        return line.into();
    }
    let [head, tail] = KEPT_BYTES;
    let (begin, end) = (line.floor_char_boundary(head), line.ceil_char_boundary(line.len() - tail));
    format!("{} … {} bytes left out … {}", &line[..begin], end - begin, &line[end..]).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_stays_and_of_a_words_megabytes_beginning_and_end_do() {
        let short = format!("a.model: one\n{}", "é".repeat(LINE_BYTES / 2));
        assert_eq!(Failure::Refused(short.clone()).to_string(), short);
        let long = format!("a.model: layers {} are not these\nnext", "é".repeat(3 << 20));
        let told = Failure::Refused(long).to_string();
        assert!(told.starts_with("a.model: layers é") && told.ends_with("é are not these\nnext"), "{told}");
        assert!(told.contains("bytes left out") && told.len() < LINE_BYTES, "{}", told.len());
    }
}
