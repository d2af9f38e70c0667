//! Faults of a file of messages.

use std::io;
use std::path::PathBuf;

/// Fault of a trace, and its place.
#[derive(Debug, thiserror::Error)]
#[error("{}: message {message}: {rule}", file.display())]
pub struct TraceError {
    /// The trace.
    pub file: PathBuf,
    /// Number of the message, from 1.
    pub message: u64,
    /// Rule that is broken.
    pub rule: TraceRule,
}

impl TraceError {
    /// Whether the machine is at fault, not the content of the file.
    pub fn is_system(&self) -> bool {
        matches!(self.rule, TraceRule::Unreadable(_))
    }
}

/// The rules of a trace, broken.
#[derive(Debug, thiserror::Error)]
pub enum TraceRule {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] io::Error),
    /// The file ends within a message or a record.
    #[error("the file ends within it: it was cut off or is still being written")]
    CutOff,
    /// A message or a record of a length that no sound one has.
    #[error(
        "{what} of {length} bytes, more than the {limit} that are read: the file is damaged, or no trace"
    )]
    TooLong {
        /// Name of what is too long.
        what: &'static str,
        /// Length as told.
        length: u64,
        /// Most bytes.
        limit: u64,
    },
    /// A record of MCAP that is none.
    #[error("a record of MCAP is damaged: {0}")]
    Record(String),
    /// A chunk that does not unpack to what it tells of itself.
    #[error("a chunk packed by `{compression}` does not unpack to the {expected} bytes that it tells")]
    Chunk {
        /// Compression as told.
        compression: String,
        /// Length as told.
        expected: u64,
    },
    /// A chunk whose sum is another one.
    #[error("a chunk's checksum is not that of its content")]
    ChunkSum,
    /// A chunk packed in a way that is not read.
    #[error("a chunk is packed by `{0}`; read are chunks as they are, and by zstd and lz4")]
    Compression(String),
    /// MCAP without a channel of the messages that are read.
    #[error("there is no channel of `{0}` in it")]
    NoChannel(&'static str),
    /// MCAP with several channels of the messages that are read.
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
    /// A message that is not encoded as Protocol Buffers encode.
    #[error("is no message of Protocol Buffers: {0}")]
    Encoding(String),
    /// A field that is needed.
    #[error("{owner}: `{field}` is missing")]
    Missing {
        /// Message that lacks it, with the object's id where it is known.
        owner: String,
        /// Name of the field.
        field: &'static str,
    },
    /// A number outside its range.
    #[error("{owner}: `{field}` is {found}; it must be {allowed}")]
    OutOfRange {
        /// Message that has it, with the object's id where it is known.
        owner: String,
        /// Name of the field.
        field: &'static str,
        /// Value as told.
        found: f64,
        /// Values that may stand there.
        allowed: &'static str,
    },
    /// A message of OSI that tells no ground truth.
    #[error("it is a {0}; a recording of traffic consists of GroundTruth, or of SensorView with one in it")]
    OtherMessage(&'static str),
    /// Fields that no message of OSI has together which a trace consists of.
    #[error("its fields are neither those of a GroundTruth of OSI nor those of a SensorView")]
    NoGroundTruth,
    /// More moving objects than a country's rush hour has.
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
