//! Use of bincode 2 behind one module: the day it has to go, it goes here
//! (docs/decisions/serialization.md).

use serde::{Serialize, de::DeserializeOwned};

/// Fixed configuration: little endian, variable-length integers. Part of the format.
fn configuration() -> impl bincode::config::Config {
    bincode::config::standard()
}

/// Bytes of a record.
pub(crate) fn encode<T: Serialize>(value: &T) -> Result<Vec<u8>, bincode::error::EncodeError> {
    bincode::serde::encode_to_vec(value, configuration())
}

/// A record from exactly these bytes; left-over bytes are an error. The slice bounds what a length inside may
/// claim: serde reserves at most 1 MiB before it has seen elements.
pub(crate) fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, String> {
    let (value, used) =
        bincode::serde::decode_from_slice(bytes, configuration()).map_err(|e| e.to_string())?;
    if used == bytes.len() { Ok(value) } else { Err(format!("{} bytes left over", bytes.len() - used)) }
}
