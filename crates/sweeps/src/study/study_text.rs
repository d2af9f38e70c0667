//! Text of a study's file, and errors about places in it.

use artifact::bounded;
use pipeline::host::failure::Failure;
use std::fmt;
use std::path::{Path, PathBuf};

/// Largest study file, a page of text.
const LIMIT_BYTES: u64 = 4 << 20;

/// A study's file with its text.
pub(crate) struct StudyText {
    pub(crate) file: PathBuf,
    pub(crate) text: String,
}

/// Line and column, from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Position {
    pub(crate) line: usize,
    pub(crate) column: usize,
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.line, self.column)
    }
}

impl StudyText {
    pub(crate) fn read(file: &Path) -> Result<Self, Failure> {
        let text = bounded::read_text(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
        Ok(Self { file: file.to_owned(), text })
    }

    /// Refusal of the value at a byte: file, line, column, place and rule.
    pub(crate) fn refused(&self, byte: usize, place: &str, rule: &str) -> Failure {
        let place = if place.is_empty() { String::new() } else { format!(" {place}:") };
        Failure::Refused(format!("{}:{}:{place} {rule}", self.file.display(), self.position(byte)))
    }

    /// Line and column of a byte, from 1.
    pub(crate) fn position(&self, byte: usize) -> Position {
        let before = self.text.get(..byte).unwrap_or(&self.text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = before.bytes().filter(|byte| *byte == b'\n').count() + 1;
        Position { line, column: before[line_start..].chars().count() + 1 }
    }
}
