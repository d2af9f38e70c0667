//! Reading of user files: only plain files, whole and of bounded length.
//!
//! A limit counts the bytes read, not the length reported by the system, which is 0 for some endless files,
//! and a file may grow while it is read. Anything but a plain file is refused before it is opened ([`open`]).

use std::io::{self, Read};
use std::path::Path;

pub use crate::files::inputs::open;

/// Reason that a file could not be read whole.
#[derive(Debug, thiserror::Error)]
pub enum ReadFault {
    /// The file is missing, unreadable, or no plain file.
    #[error("cannot be read: {0}")]
    System(#[from] io::Error),
    /// The file is longer than its reader allows.
    #[error("has more than {limit} bytes, the most that are read")]
    TooLong {
        /// Maximum number of bytes allowed.
        limit: u64,
    },
    /// The file is not text.
    #[error("is not UTF-8 text from byte {byte} on")]
    NotText {
        /// Index of the first invalid byte, from 0.
        byte: usize,
    },
}

impl ReadFault {
    /// Whether the system is at fault, rather than the content of the file.
    pub fn is_system(&self) -> bool {
        matches!(self, Self::System(_))
    }
}

/// Reads all bytes of a plain file, at most `limit`.
///
/// # Errors
/// The file is longer, unreadable, or no plain file.
pub fn read(file: &Path, limit: u64) -> Result<Vec<u8>, ReadFault> {
    let handle = open(file)?;
    let told = handle.metadata()?.len();
    read_at_most(handle, told, limit)
}

/// Reads the text of a plain file of at most `limit` bytes.
///
/// # Errors
/// Those of [`read`], and text that is not UTF-8.
pub fn read_text(file: &Path, limit: u64) -> Result<String, ReadFault> {
    let bytes = read(file, limit)?;
    String::from_utf8(bytes).map_err(|error| ReadFault::NotText { byte: error.utf8_error().valid_up_to() })
}

/// Reads all of `source`, at most `limit` bytes; the reported length `told` serves only for early refusal and
/// to reserve memory.
fn read_at_most(source: impl Read, told: u64, limit: u64) -> Result<Vec<u8>, ReadFault> {
    let too_long = ReadFault::TooLong { limit };
    if told > limit {
        return Err(too_long);
    }
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(told as usize).map_err(|_| io::Error::from(io::ErrorKind::OutOfMemory))?;
    source.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit { Err(too_long) } else { Ok(bytes) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_endless_source_ends_at_the_limit_whatever_length_is_told() {
        for told in [0, 3, 100] {
            let got = read_at_most(io::repeat(7), told, 100);
            assert!(matches!(got, Err(ReadFault::TooLong { limit: 100 })), "{told}: {got:?}");
        }
        assert_eq!(read_at_most(io::repeat(7).take(100), 0, 100).unwrap(), vec![7; 100]);
        assert!(matches!(read_at_most(io::empty(), 101, 100), Err(ReadFault::TooLong { .. })));
    }

    #[test]
    fn a_socket_and_a_folder_are_refused_before_they_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let got = read(folder.path(), 100).unwrap_err();
        assert!(got.is_system(), "{got}");
        #[cfg(unix)]
        {
            let place = folder.path().join("socket");
            let _listening = std::os::unix::net::UnixListener::bind(&place).unwrap();
            let text = read(&place, 100).unwrap_err().to_string();
            assert_eq!(text, "cannot be read: it is a socket, and plain files alone are read");
        }
    }

    #[test]
    fn text_is_refused_at_the_byte_that_fits_no_character() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("t");
        std::fs::write(&place, b"ab\xffc").unwrap();
        assert!(matches!(read_text(&place, 4), Err(ReadFault::NotText { byte: 2 })));
        assert!(matches!(read_text(&place, 3), Err(ReadFault::TooLong { limit: 3 })));
    }
}
