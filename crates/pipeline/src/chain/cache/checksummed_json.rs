//! Small records that a cache keeps as JSON, each with the checksum of its text: a damaged one is named and
//! ignored.

use crate::chain::cache::cache_files;
use crate::host::{files, progress};
use artifact::atomic_file::{self, Durability};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::io::ErrorKind;
use std::path::Path;

/// A text with its BLAKE3 hash.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ChecksummedText {
    blake3: String,
    text: String,
}

/// Largest record: a key is a handful of hashes.
const LIMIT_BYTES: u64 = 1 << 20;

/// Reads a record; `None` if it is missing or its checksum is wrong.
pub(super) fn read<T: DeserializeOwned>(place: &Path) -> Option<T> {
    let bytes = match files::read_own(place, LIMIT_BYTES) {
        Err(error) if error.kind() == ErrorKind::FileTooLarge => vec![],
        bytes => bytes.ok()?,
    };
    let value = opened(&bytes);
    if value.is_none() && !is_of_earlier_version(&bytes) {
        progress::note(format!("note: {}: is damaged and not believed", place.display()));
    }
    value
}

/// Writes a record; a failure to write is ignored.
pub(super) fn write<T: Serialize>(place: &Path, value: &T) {
    let Ok(text) = serde_json::to_string(value) else { return };
    let Ok(bytes) = serde_json::to_vec(&ChecksummedText { blake3: checksum(&text), text }) else { return };
    if !cache_files::is_link(place) {
        let _ = atomic_file::write(place, &bytes, Durability::InCache);
    }
}

fn opened<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    let sealed: ChecksummedText = serde_json::from_slice(bytes).ok()?;
    (sealed.blake3 == checksum(&sealed.text)).then(|| serde_json::from_str(&sealed.text).ok()).flatten()
}

fn checksum(text: &str) -> String {
    blake3::hash(text.as_bytes()).to_hex().to_string()
}

/// Whether the record is a bare key without a checksum, as earlier versions wrote it: such a record is
/// ignored without a remark.
fn is_of_earlier_version(bytes: &[u8]) -> bool {
    serde_json::from_slice::<crate::chain::keys::Key>(bytes).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::keys::Key;

    #[test]
    fn no_changed_byte_and_no_cut_is_believed() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("small-0000.json");
        let key = Key { parts: vec![("radar".into(), "0123".into()), ("poses".into(), "4567".into())] };
        write(&place, &key);
        assert_eq!(read::<Key>(&place), Some(key.clone()));
        let whole = std::fs::read(&place).unwrap();
        for at in 0..whole.len() {
            std::fs::write(&place, &whole[..at]).unwrap();
            assert_eq!(read::<Key>(&place), None, "cut at {at}");
            for bit in 0..8 {
                let mut damaged = whole.clone();
                damaged[at] ^= 1 << bit;
                std::fs::write(&place, damaged).unwrap();
                // A letter of an escape may be written in two ways.
                assert!(read::<Key>(&place).is_none_or(|read| read == key), "bit {bit} of byte {at}");
            }
        }
    }
}
