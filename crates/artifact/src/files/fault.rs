//! A file and its fault.

use crate::files::output_path::OutputPathFault;
use std::path::{Path, PathBuf};

/// A file and its fault.
#[derive(Debug, thiserror::Error)]
#[error("{}: {fault}", file.display())]
pub struct ArtifactError {
    /// File of the artifact.
    pub file: PathBuf,
    /// The rule that it breaks, or the system's error.
    pub fault: Fault,
}

/// Fault of an artifact.
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// System error: missing, unreadable, unwritable, disk full.
    #[error("cannot {doing}: {cause}")]
    System {
        /// Action that the system refused, as in "cannot open".
        doing: &'static str,
        /// The system's answer.
        cause: std::io::Error,
    },
    /// An output that may not be placed at the requested path.
    #[error("cannot be written: {0}")]
    Place(OutputPathFault),
    /// The first bytes are not those of the envelope.
    #[error("not a Wayside artifact (the first 8 bytes are not its magic)")]
    Magic,
    /// The file holds another kind of artifact than requested.
    #[error("is a `{found}` artifact where a `{expected}` artifact is needed")]
    Schema {
        /// Kind of artifact that is needed.
        expected: &'static str,
        /// Kind of artifact in the file.
        found: String,
    },
    /// The file was written by another version of the schema.
    #[error("`{schema}` version {found}; this program reads version {known}")]
    Version {
        /// Kind of artifact.
        schema: String,
        /// Version of the schema in the file.
        found: u32,
        /// Version of the schema that this program reads.
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
    /// The end mark states another number of frames.
    #[error("holds {found} frames where its end mark tells of {told}")]
    Count {
        /// Number of frames read.
        found: u64,
        /// Number of frames in the end mark.
        told: u64,
    },
    /// A length that the file or the schema cannot hold.
    #[error("byte {offset}: {record} claims {length} bytes, the limit is {limit}")]
    TooLong {
        /// Name of the record.
        record: String,
        /// Byte of the file at which the record starts.
        offset: u64,
        /// Length that the record claims, bytes.
        length: u64,
        /// Largest length of such a record, bytes.
        limit: u64,
    },
    /// A record with a correct checksum that does not fit the schema.
    #[error("byte {offset}: {record} is not of the schema's shape: {why}")]
    Shape {
        /// Name of the record.
        record: String,
        /// Byte of the file at which the record starts.
        offset: u64,
        /// Message of the decoder.
        why: String,
    },
    /// A byte that starts no record, where a record should start.
    #[error("byte {offset}: no record begins with {found:#04x}")]
    Marker {
        /// Offset of the byte in the file.
        offset: u64,
        /// Byte where a record should start.
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
    /// Whether the system (missing, unreadable, disk full) or the place of an output is at fault, rather than
    /// the content.
    pub fn is_system(&self) -> bool {
        matches!(self.fault, Fault::System { .. } | Fault::Place(_))
    }
}
