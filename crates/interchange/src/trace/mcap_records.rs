//! Records of MCAP in a file or in a decompressed chunk: a byte for the kind, eight for the length, the
//! content. Other records are skipped unread.

use crate::trace::fault::TraceRule;
use crate::trace::osi_file::{exactly, read_up_to};
use std::io::Read;

/// First and last bytes of every file.
pub(crate) const MAGIC: [u8; 8] = [0x89, b'M', b'C', b'A', b'P', 0x30, b'\r', b'\n'];

/// Largest record, and largest decompressed chunk, bytes: twice what the tools of OSI write.
pub(crate) const RECORD_LIMIT_BYTES: u64 = 64 << 20;

/// Kind and content of a record.
pub(crate) type RawRecord = (u8, Vec<u8>);

/// Reads the next record of the requested kinds; `None` at the end of the source.
pub(crate) fn next(source: &mut impl Read, asked: &[u8]) -> Result<Option<RawRecord>, TraceRule> {
    loop {
        let mut head = [0; 9];
        match read_up_to(source, &mut head)? {
            0 => return Ok(None),
            9 => {}
            _ => return Err(TraceRule::CutOff),
        }
        let [kind, length @ ..] = head;
        let length = u64::from_le_bytes(length);
        if asked.contains(&kind) {
            if length > RECORD_LIMIT_BYTES {
                return Err(TraceRule::TooLong { what: "a record", length, limit: RECORD_LIMIT_BYTES });
            }
            return Ok(Some((kind, exactly(source, length)?)));
        }
        pass_over(source, length)?;
    }
}

fn pass_over(source: &mut impl Read, length: u64) -> Result<(), TraceRule> {
    let passed = std::io::copy(&mut source.take(length), &mut std::io::sink())?;
    if passed == length { Ok(()) } else { Err(TraceRule::CutOff) }
}
