//! The single-channel binary trace of OSI: four bytes of length, little-endian, and a message, repeated.

use crate::trace::fault::TraceRule;
use std::io::{self, Read, Write};

/// Largest message in bytes: a city's map with its lanes takes a tenth.
pub(crate) const MESSAGE_LIMIT_BYTES: u64 = 64 << 20;

/// The next message; `None` at the end of the file.
pub(crate) fn next(source: &mut impl Read) -> Result<Option<Vec<u8>>, TraceRule> {
    let mut length = [0; 4];
    let read = read_up_to(source, &mut length)?;
    match read {
        0 => return Ok(None),
        4 => {}
        _ => return Err(TraceRule::CutOff),
    }
    let length = u64::from(u32::from_le_bytes(length));
    if length > MESSAGE_LIMIT_BYTES {
        return Err(TraceRule::TooLong { what: "a message", length, limit: MESSAGE_LIMIT_BYTES });
    }
    exactly(source, length).map(Some)
}

/// Reads `length` bytes without allocating more than are present.
pub(crate) fn exactly(source: &mut impl Read, length: u64) -> Result<Vec<u8>, TraceRule> {
    let mut bytes = Vec::new();
    source.take(length).read_to_end(&mut bytes)?;
    if bytes.len() as u64 == length { Ok(bytes) } else { Err(TraceRule::CutOff) }
}

/// Fills a buffer as far as the source has data.
pub(crate) fn read_up_to(source: &mut impl Read, buffer: &mut [u8]) -> io::Result<usize> {
    let mut filled = 0;
    while filled < buffer.len() {
        match source.read(&mut buffer[filled..]) {
            Ok(0) => break,
            Ok(read) => filled += read,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(filled)
}

/// Writes a message after its length.
pub(crate) fn write(sink: &mut impl Write, message: &[u8]) -> io::Result<()> {
    let length = u32::try_from(message.len()).map_err(io::Error::other)?;
    sink.write_all(&length.to_le_bytes())?;
    sink.write_all(message)
}
