//! A picture of eight bits a channel as PNG (ISO/IEC 15948), unfiltered.

use flate2::{Compression, Crc, write::ZlibEncoder};
use std::io::{self, Write};

/// `pixels` row by row from the top left.
pub(crate) fn encode([width, height]: [usize; 2], pixels: &[[u8; 3]]) -> io::Result<Vec<u8>> {
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::default());
    for row in pixels.chunks(width) {
        packed.write_all(&[0])?;
        packed.write_all(row.as_flattened())?;
    }
    let mut header = [width as u32, height as u32].map(u32::to_be_bytes).concat();
    header.extend([8, 2, 0, 0, 0]);
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    for (kind, data) in [(b"IHDR", header), (b"IDAT", packed.finish()?), (b"IEND", Vec::new())] {
        chunk(kind, &data, &mut file);
    }
    Ok(file)
}

fn chunk(kind: &[u8; 4], data: &[u8], file: &mut Vec<u8>) {
    let mut check = Crc::new();
    check.update(kind);
    check.update(data);
    file.extend((data.len() as u32).to_be_bytes());
    file.extend(kind);
    file.extend(data);
    file.extend(check.sum().to_be_bytes());
}
