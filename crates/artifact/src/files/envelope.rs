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
//! both, a wrong checksum, a missing end mark (checked before the first frame is returned), and, before it
//! allocates, any length beyond the schema's limit or the file's size.

mod writer;
mod reader;

pub use crate::files::fault::{ArtifactError, Fault};
pub use reader::{Reader, read_preamble};
pub use writer::Writer;

use serde::{Deserialize, Serialize, de::DeserializeOwned};

/// First bytes of an artifact.
pub const MAGIC: &[u8; 8] = b"WAYSIDE\n";
pub(crate) const CHECKSUM_BYTES: usize = 16;
pub(crate) const END_BYTES: u64 = 1 + 8 + CHECKSUM_BYTES as u64;
/// Maximum length of a preamble: provenance is a handful of hashes, more is damage.
pub(crate) const PREAMBLE_LIMIT: u64 = 1 << 20;

/// A kind of artifact: the names and types that its envelope holds.
pub trait Schema {
    /// Name in the envelope, and the file extension.
    const NAME: &'static str;
    /// Version of the schema, incremented when `Header` or `Frame` change shape.
    const VERSION: u32;
    /// Maximum record length that a reader allocates, bytes.
    const RECORD_LIMIT: u64 = 4 << 30;
    /// Header, common to all frames; a reader refuses one that contains a NaN, which equals nothing.
    type Header: PartialEq + Serialize + DeserializeOwned;
    /// One radar frame.
    type Frame: Serialize + DeserializeOwned;

    /// Contradiction between a frame and its header or its own rules, worded to follow "frame 1 is not of the
    /// schema's shape: "; `None` for a valid frame. A reader refuses a frame with a contradiction.
    fn contradiction(_header: &Self::Header, _frame: &Self::Frame) -> Option<String> {
        None
    }

    /// Minimum size in bytes of a frame with this header. A file too short for the number of frames that it
    /// claims is refused when opened, before anything is planned from its header.
    fn least_frame_bytes(_header: &Self::Header) -> u64 {
        0
    }
}

/// Origin of an artifact; without clock or host, so that equal work gives equal bytes.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Stage that wrote the artifact.
    pub stage: String,
    /// Version of the program.
    pub program_version: String,
    /// Name and BLAKE3 hash of each input.
    pub inputs: Vec<(String, String)>,
    /// The settings as used, as text.
    pub settings: String,
    /// Seed of all randomness.
    pub seed: u64,
}

/// Description of an artifact that precedes its content.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Preamble {
    /// Name of the schema, [`Schema::NAME`].
    pub schema: String,
    /// Version of the schema, [`Schema::VERSION`].
    pub version: u32,
    /// Origin of the artifact.
    pub provenance: Provenance,
}

/// BLAKE3 hash of a value's encoding, for cache keys: equal values have equal fingerprints on every machine.
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
