//! One file format for all artifacts.
//!
//! ```text
//! magic "WAYSIDE\n"
//! preamble   length u64 | checksum 16 bytes | schema name, version, provenance
//! header     'H' | length | checksum | what is common to all frames
//! frame      'F' | length | checksum | one radar frame           (any number)
//! end        'E' | number of frames u64 | checksum
//! ```
//!
//! Integers are little endian, checksums the first half of BLAKE3. A reader refuses a newer version naming
//! both, a wrong checksum, a missing end (looked for before the first frame is handed out), and any length
//! beyond the schema's limit or the file's size before it allocates.

mod writer;
mod reader;

pub use crate::files::fault::{ArtifactError, Fault};
pub use reader::{Reader, read_preamble};
pub use writer::Writer;

use serde::{Deserialize, Serialize, de::DeserializeOwned};

pub(crate) const MAGIC: &[u8; 8] = b"WAYSIDE\n";
pub(crate) const CHECKSUM_BYTES: usize = 16;
pub(crate) const END_BYTES: u64 = 1 + 8 + CHECKSUM_BYTES as u64;
/// Provenance is a handful of hashes; more is damage.
pub(crate) const PREAMBLE_LIMIT: u64 = 1 << 20;

/// A kind of artifact: the names and types that its envelope holds.
pub trait Schema {
    /// Name in the envelope, and the file extension.
    const NAME: &'static str;
    /// Version of the schema, raised when `Header` or `Frame` change shape.
    const VERSION: u32;
    /// Longest record that a reader allocates for, bytes.
    const RECORD_LIMIT: u64 = 4 << 30;
    /// Header, common to all frames.
    type Header: Serialize + DeserializeOwned;
    /// One radar frame.
    type Frame: Serialize + DeserializeOwned;

    /// Contradiction between a frame and its header or its own rules, in words that follow "frame 1 is not of
    /// the schema's shape: "; `None` of a sound one. A reader refuses such a frame.
    fn contradiction(_header: &Self::Header, _frame: &Self::Frame) -> Option<String> {
        None
    }

    /// Fewest bytes that a frame of this header takes. A file too short for the frames that it tells of is
    /// refused when it is opened, before anything is planned by its header.
    fn least_frame_bytes(_header: &Self::Header) -> u64 {
        0
    }
}

/// Origin of an artifact: no clock, no host, so that equal work gives equal bytes.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Stage that wrote it.
    pub stage: String,
    /// Version of the program.
    pub program_version: String,
    /// Name and BLAKE3 of each input.
    pub inputs: Vec<(String, String)>,
    /// The settings as used, as text.
    pub settings: String,
    /// Seed of everything random.
    pub seed: u64,
}

/// Description of an artifact that stands before its content.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Preamble {
    /// Name of the schema, [`Schema::NAME`].
    pub schema: String,
    /// Version of the schema, [`Schema::VERSION`].
    pub version: u32,
    /// Origin of the artifact.
    pub provenance: Provenance,
}

/// BLAKE3 of a value as it would be written: equal values, equal fingerprints, on every machine. For cache
/// keys.
pub fn fingerprint<T: Serialize>(value: &T) -> String {
    match crate::files::codec::encode(value) {
        Ok(bytes) => blake3::hash(&bytes).to_hex().to_string(),
        Err(error) => format!("cannot be encoded: {error}"),
    }
}

pub(crate) fn checksum(bytes: &[u8]) -> [u8; CHECKSUM_BYTES] {
    let mut short = [0; CHECKSUM_BYTES];
    short.copy_from_slice(&blake3::hash(bytes).as_bytes()[..CHECKSUM_BYTES]);
    short
}

pub(crate) fn end_mark(frames: u64) -> [u8; END_BYTES as usize] {
    let mut mark = [0; END_BYTES as usize];
    mark[0] = b'E';
    mark[1..9].copy_from_slice(&frames.to_le_bytes());
    let sum = checksum(&mark[..9]);
    mark[9..].copy_from_slice(&sum);
    mark
}
