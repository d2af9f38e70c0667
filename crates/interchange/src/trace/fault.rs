//! Faults of a file of messages.

use std::io;
use std::path::PathBuf;

/// Fault of a trace with its place.
#[derive(Debug, thiserror::Error)]
#[error("{}: message {message}: {rule}", file.display())]
pub struct TraceError {
    /// The trace.
    pub file: PathBuf,
    /// Number of the message, from 1.
    pub message: u64,
    /// Broken rule.
    pub rule: TraceRule,
}

impl TraceError {
    /// Whether the system is at fault, not the content of the file.
    pub fn is_system(&self) -> bool {
        matches!(self.rule, TraceRule::Unreadable(_))
    }
}

/// Broken rules of a trace.
#[derive(Debug, thiserror::Error)]
pub enum TraceRule {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] io::Error),
    /// The file ends within a message or a record.
    #[error("the file ends within it: it was cut off or is still being written")]
    CutOff,
    /// A message or a record longer than any valid one.
    #[error(
        "{what} of {length} bytes, more than the {limit} that are read: the file is damaged, or no trace"
    )]
    TooLong {
        /// Name of the message or record.
        what: &'static str,
        /// Declared length.
        length: u64,
        /// Largest number of bytes.
        limit: u64,
    },
    /// An invalid record of MCAP.
    #[error("a record of MCAP is damaged: {0}")]
    Record(String),
    /// A chunk that does not decompress to its declared length.
    #[error("a chunk packed by `{compression}` does not unpack to the {expected} bytes that it tells")]
    Chunk {
        /// Declared compression.
        compression: String,
        /// Declared length.
        expected: u64,
    },
    /// A chunk with a wrong checksum.
    #[error("a chunk's checksum is not that of its content")]
    ChunkSum,
    /// A chunk with unsupported compression.
    #[error("a chunk is packed by `{0}`; read are chunks as they are, and by zstd and lz4")]
    Compression(String),
    /// MCAP without a channel of the requested messages.
    #[error("there is no channel of `{0}` in it")]
    NoChannel(&'static str),
    /// MCAP with several channels of the requested messages.
    #[error(
        "there are two channels of `{schema}` in it, `{first}` and `{second}`: write one of them into a file of its own"
    )]
    SeveralChannels {
        /// Schema of both.
        schema: &'static str,
        /// Topic of the first.
        first: String,
        /// Topic of the second.
        second: String,
    },
    /// A message that is not encoded in Protocol Buffers.
    #[error("is no message of Protocol Buffers: {0}")]
    Encoding(String),
    /// A required field is missing.
    #[error("{owner}: `{field}` is missing")]
    Missing {
        /// Message that lacks it, with the object's id if known.
        owner: String,
        /// Name of the field.
        field: &'static str,
    },
    /// A number outside its range.
    #[error("{owner}: `{field}` is {found}; it must be {allowed}")]
    OutOfRange {
        /// Message that contains it, with the object's id if known.
        owner: String,
        /// Name of the field.
        field: &'static str,
        /// Value in the message.
        found: f64,
        /// Allowed values.
        allowed: &'static str,
    },
    /// A message of OSI without ground truth.
    #[error("it is a {0}; a recording of traffic consists of GroundTruth, or of SensorView with one in it")]
    OtherMessage(&'static str),
    /// Fields that do not belong to any supported message of OSI.
    #[error("its fields are neither those of a GroundTruth of OSI nor those of a SensorView")]
    NoGroundTruth,
    /// More moving objects than in a country's rush hour.
    #[error("more than {0} moving objects")]
    TooManyObjects(usize),
}

impl From<io::Error> for TraceRule {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::UnexpectedEof => Self::CutOff,
            _ => Self::Unreadable(error),
        }
    }
}
