//! A file and what is wrong with it.

use crate::files::place_rule::PlaceRule;
use std::path::{Path, PathBuf};

/// A file and what is wrong with it.
#[derive(Debug, thiserror::Error)]
#[error("{}: {fault}", file.display())]
pub struct ArtifactError {
    /// The artifact.
    pub file: PathBuf,
    /// The rule it broke, or what the system answered.
    pub fault: Fault,
}

/// Fault of an artifact.
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// The system refused: missing, unreadable, unwritable, disk full.
    #[error("cannot {doing}: {cause}")]
    System {
        /// Action that was tried.
        doing: &'static str,
        /// The system's answer.
        cause: std::io::Error,
    },
    /// An output that may not be put where it was asked for.
    #[error("cannot be written: {0}")]
    Place(PlaceRule),
    /// The first bytes are not the envelope's.
    #[error("not a Wayside artifact (the first 8 bytes are not its magic)")]
    Magic,
    /// The file holds another kind of artifact than asked for.
    #[error("is a `{found}` artifact where a `{expected}` artifact is needed")]
    Schema {
        /// Kind that was asked for.
        expected: &'static str,
        /// Kind in the file.
        found: String,
    },
    /// The file was written by another version of the schema.
    #[error("`{schema}` version {found}; this program reads version {known}")]
    Version {
        /// Kind of artifact.
        schema: String,
        /// Version in the file.
        found: u32,
        /// Version known here.
        known: u32,
    },
    /// Bytes changed since they were written.
    #[error("byte {offset}: checksum of {record} does not match: the file is damaged")]
    Checksum {
        /// Name of the record.
        record: String,
        /// Byte of the file at which the record starts.
        offset: u64,
    },
    /// The file is cut off, or still being written by a program that died.
    #[error("has no end mark: the file is cut off")]
    MissingEnd,
    /// The end mark tells of another number of frames.
    #[error("holds {found} frames where its end mark tells of {told}")]
    Count {
        /// Frames read.
        found: u64,
        /// Frames told.
        told: u64,
    },
    /// A length that the file or the schema cannot hold.
    #[error("byte {offset}: {record} claims {length} bytes, the limit is {limit}")]
    TooLong {
        /// Name of the record.
        record: String,
        /// Byte of the file at which the record starts.
        offset: u64,
        /// Length that the record claims.
        length: u64,
        /// Length that is allowed.
        limit: u64,
    },
    /// A record of the right checksum that is not of the schema's shape.
    #[error("byte {offset}: {record} is not of the schema's shape: {why}")]
    Shape {
        /// Name of the record.
        record: String,
        /// Byte of the file at which the record starts.
        offset: u64,
        /// The decoder's words.
        why: String,
    },
    /// Bytes where a record should begin that begin none.
    #[error("byte {offset}: no record begins with {found:#04x}")]
    Marker {
        /// Byte of the file at which they stand.
        offset: u64,
        /// The byte.
        found: u8,
    },
}

impl Fault {
    pub(crate) fn of(self, file: &Path) -> ArtifactError {
        ArtifactError { file: file.to_owned(), fault: self }
    }

    pub(crate) fn system(doing: &'static str) -> impl FnOnce(std::io::Error) -> Self {
        move |cause| Self::System { doing, cause }
    }
}

impl ArtifactError {
    /// Whether the system refused (missing, unreadable, disk full) or the place of an output, not the
    /// content.
    pub fn is_system(&self) -> bool {
        matches!(self.fault, Fault::System { .. } | Fault::Place(_))
    }
}
