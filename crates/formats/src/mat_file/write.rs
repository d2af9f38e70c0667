//! Writing of an array as a file.

use crate::mat_file::{COMPLEX, HEAD_BYTES, INT8, INT32, MATRIX, SINGLE, UINT32};
use num_complex::Complex32;

/// Class of arrays of single precision.
const CLASS_SINGLE: u32 = 7;

/// An array to write.
pub(crate) struct ComplexArray<'a> {
    pub(crate) name: &'a str,
    /// Sides, the fastest first.
    pub(crate) shape: [usize; 4],
    pub(crate) values: &'a [Complex32],
}

impl ComplexArray<'_> {
    /// The file, uncompressed.
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let sides: Vec<u8> = self.shape.iter().flat_map(|side| (*side as u32).to_le_bytes()).collect();
        let parts = |part: fn(&Complex32) -> f32| -> Vec<u8> {
            self.values.iter().map(part).flat_map(f32::to_le_bytes).collect()
        };
        let flags = [CLASS_SINGLE | COMPLEX, 0].map(u32::to_le_bytes).concat();
        let content = [
            element(UINT32, &flags),
            element(INT32, &sides),
            element(INT8, self.name.as_bytes()),
            element(SINGLE, &parts(|value| value.re)),
            element(SINGLE, &parts(|value| value.im)),
        ];
        [head(), element(MATRIX, &content.concat())].concat()
    }
}

/// Head of a file: text, no offset to other data, version 1.0, the byte-order mark.
fn head() -> Vec<u8> {
    let mut head = b"MATLAB 5.0 MAT-file, written by wayside".to_vec();
    head.resize(HEAD_BYTES - 12, b' ');
    head.extend([0; 8]);
    head.extend([0, 1, b'I', b'M']);
    head
}

fn element(kind: u32, content: &[u8]) -> Vec<u8> {
    let mut bytes = [kind.to_le_bytes(), (content.len() as u32).to_le_bytes()].concat();
    bytes.extend(content);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}
