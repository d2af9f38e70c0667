//! Buffers of a glTF: the binary chunk, files beside it, or base64 in its JSON.

use crate::mesh::error::{LocatedFault, MeshFault, MeshPlace};
use crate::mesh::format::LIMIT_BYTES;
use crate::mesh::gltf_json::check_values;
use crate::wording::reference::{self, ReferenceFault};
use artifact::bounded::{self, ReadFault};
use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::general_purpose::{GeneralPurpose, GeneralPurposeConfig, NO_PAD};
use gltf::json::{Buffer, Root, deserialize};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Bytes of each buffer, at least as many as declared.
pub(crate) type Buffers = Vec<Vec<u8>>;

/// Splits a `.glb` into JSON and binary chunk.
pub(crate) fn split_container(bytes: &[u8]) -> Result<(Vec<u8>, Option<Vec<u8>>), MeshFault> {
    let header: u64 = 12;
    let found = bytes.len() as u64;
    if found < header {
        return Err(MeshFault::CutOff { found, needed: header });
    }
    // The crate subtracts the header from this length unchecked.
    let needed = u64::from(u32::from_le_bytes([bytes[8], bytes[9], bytes[10], bytes[11]])).max(header);
    if bytes.starts_with(b"glTF") && (found < needed || needed == header) {
        return Err(MeshFault::CutOff { found, needed: needed.max(header + 8) });
    }
    let parts = gltf::binary::Glb::from_slice(bytes).map_err(MeshFault::Container)?;
    Ok((parts.json.into_owned(), parts.bin.map(std::borrow::Cow::into_owned)))
}

/// Reads all buffers, each of its declared length.
pub(crate) fn read_buffers(
    root: &Root,
    binary: Option<Vec<u8>>,
    path: &Path,
) -> Result<Buffers, LocatedFault> {
    let mut binary = binary;
    let mut left = LIMIT_BYTES;
    let buffers = root.buffers.iter().enumerate();
    buffers
        .map(|(i, buffer)| {
            // The chunk belongs to the first buffer, if that has no URI (glTF 2.0, 4.4.3.2).
            let chunk = if i == 0 { binary.take() } else { None };
            let bytes =
                read_buffer(buffer, chunk, path, left).map_err(|fault| MeshPlace::Buffer(i).fault(fault))?;
            left = left.saturating_sub(bytes.len() as u64);
            Ok(bytes)
        })
        .collect()
}

/// Buffer files that a `.gltf` names, each once in any spelling; none if the JSON is invalid.
pub(crate) fn files_beside(json: &[u8], path: &Path) -> Vec<PathBuf> {
    let root = check_values(json).ok().and_then(|()| deserialize::from_slice::<Root>(json).ok());
    let buffers = root.iter().flat_map(|root| &root.buffers);
    let mut known = BTreeSet::new();
    let files = buffers.filter_map(|buffer| file_of(buffer.uri.as_deref()?, path).ok());
    files.filter(|file| known.insert(file.canonicalize().unwrap_or(file.clone()))).collect()
}

/// Reads a buffer, at most `left` bytes of it.
fn read_buffer(
    buffer: &Buffer,
    chunk: Option<Vec<u8>>,
    path: &Path,
    left: u64,
) -> Result<Vec<u8>, MeshFault> {
    let bytes = match (&buffer.uri, chunk) {
        (Some(uri), _) => read_uri(uri, path, left)?,
        (None, Some(chunk)) => chunk,
        (None, None) => return Err(MeshFault::BufferMissing),
    };
    let (end, found) = (buffer.byte_length.0, bytes.len() as u64);
    if end > found { Err(MeshFault::Outside { end, bytes: found }) } else { Ok(bytes) }
}

fn read_uri(uri: &str, path: &Path, left: u64) -> Result<Vec<u8>, MeshFault> {
    if let Some(data) = uri.strip_prefix("data:") {
        let encoded = data.split_once(";base64,").map(|(_, encoded)| encoded);
        return encoded.and_then(base64).ok_or(MeshFault::BadUri);
    }
    let file = file_of(uri, path)?;
    bounded::read(&file, left).map_err(|error| match error {
        ReadFault::TooLong { limit } if limit < LIMIT_BYTES => {
            MeshFault::BuffersTooLong { limit: LIMIT_BYTES }
        }
        error => MeshFault::BufferUnread { path: file, error },
    })
}

/// The file that a `uri` names.
fn file_of(uri: &str, path: &Path) -> Result<PathBuf, MeshFault> {
    reference::file_of(uri, path).map_err(|fault| match fault {
        ReferenceFault::Malformed => MeshFault::BadUri,
        ReferenceFault::Outside => MeshFault::UriOutside,
    })
}

/// Decodes base64 (RFC 4648, 4), padded or not; `None` if the text is invalid.
fn base64(text: &str) -> Option<Vec<u8>> {
    const UNPADDED: GeneralPurposeConfig = NO_PAD.with_decode_allow_trailing_bits(true);
    GeneralPurpose::new(&STANDARD, UNPADDED).decode(text.trim_end_matches('=')).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_decodes_the_vectors_of_rfc_4648_and_refuses_the_rest() {
        for (text, bytes) in [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm9v", "foo"), ("Zm9vYg==", "foob")]
        {
            assert_eq!(base64(text).as_deref(), Some(bytes.as_bytes()), "{text}");
        }
        for text in ["Z", "Zm9vY", "Zm\n9v", "Zm9-", "é"] {
            assert_eq!(base64(text), None, "{text}");
        }
    }

    #[test]
    fn buffer_references_are_relative_and_percent_decoded() {
        let path = Path::new("models/car.gltf");
        assert_eq!(file_of("a%20b.bin", path).unwrap(), PathBuf::from("models/a b.bin"));
        for uri in ["", "https://example.invalid/car.bin", "C:\\car.bin", "a%2.bin", "a%ff.bin"] {
            assert!(matches!(file_of(uri, path), Err(MeshFault::BadUri)), "{uri}");
        }
        for uri in ["/etc/car.bin", "%2Fetc/car.bin", "\\car.bin", "a/..", "%2e%2e/a.bin", "C%3Acar.bin"] {
            assert!(matches!(file_of(uri, path), Err(MeshFault::UriOutside)), "{uri}");
        }
    }
}
