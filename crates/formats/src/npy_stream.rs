//! NumPy arrays written frame by frame, so that their size is limited by the disk, not by memory (available
//! libraries write an array that is already whole in memory).

use num_complex::{Complex32, Complex64};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use std::io::Write;
use std::path::Path;

/// An element type of NumPy.
pub trait Element: Copy {
    /// NumPy's name of the type, little endian.
    const DESCRIPTION: &'static str;
    /// Appends its bytes.
    fn append(self, bytes: &mut Vec<u8>);
}

impl Element for u8 {
    const DESCRIPTION: &'static str = "|u1";
    fn append(self, bytes: &mut Vec<u8>) {
        bytes.push(self);
    }
}

impl Element for f32 {
    const DESCRIPTION: &'static str = "<f4";
    fn append(self, bytes: &mut Vec<u8>) {
        bytes.extend_from_slice(&self.to_le_bytes());
    }
}

impl Element for Complex32 {
    const DESCRIPTION: &'static str = "<c8";
    fn append(self, bytes: &mut Vec<u8>) {
        bytes.extend_from_slice(&self.re.to_le_bytes());
        bytes.extend_from_slice(&self.im.to_le_bytes());
    }
}

impl Element for Complex64 {
    const DESCRIPTION: &'static str = "<c16";
    fn append(self, bytes: &mut Vec<u8>) {
        bytes.extend_from_slice(&self.re.to_le_bytes());
        bytes.extend_from_slice(&self.im.to_le_bytes());
    }
}

/// An array being written.
pub struct NpyStream<'a> {
    sink: &'a mut dyn Write,
}

impl NpyStream<'_> {
    /// Writes `file` whole or not at all: the header for `shape`, then what `content` appends, row-major.
    pub fn write<T: Element>(
        file: &Path,
        shape: &[usize],
        content: impl FnOnce(&mut NpyStream<'_>) -> std::io::Result<()>,
    ) -> Result<(), Failure> {
        files::write_durably(file, |sink| {
            sink.write_all(&header::<T>(shape))?;
            content(&mut NpyStream { sink })
        })
    }

    /// Appends elements.
    pub fn append<T: Element>(&mut self, elements: &[T]) -> std::io::Result<()> {
        let mut bytes = Vec::with_capacity(std::mem::size_of_val(elements));
        elements.iter().for_each(|e| e.append(&mut bytes));
        self.sink.write_all(&bytes)
    }
}

/// Header in version 1.0 of the format: magic, length, a Python dictionary padded to a multiple of 64 bytes
/// (NumPy NEP 1).
fn header<T: Element>(shape: &[usize]) -> Vec<u8> {
    let shape: String = shape.iter().map(|n| format!("{n}, ")).collect();
    let mut text = format!("{{'descr': '{}', 'fortran_order': False, 'shape': ({shape}), }}", T::DESCRIPTION);
    let used = 10 + text.len() + 1;
    text.push_str(&" ".repeat(used.next_multiple_of(64) - used));
    text.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend_from_slice(&(text.len() as u16).to_le_bytes());
    bytes.extend_from_slice(text.as_bytes());
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray_npy::ReadNpyExt;

    #[test]
    fn a_stream_is_read_back_by_another_library() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.npy");
        let rows = [
            [Complex32::new(1.0, -2.0), Complex32::new(0.5, 0.0)],
            [Complex32::new(3.0, 4.0), Complex32::i()],
        ];
        NpyStream::write::<Complex32>(&file, &[2, 2], |s| rows.iter().try_for_each(|r| s.append(r))).unwrap();
        let array = ndarray::Array2::<Complex32>::read_npy(std::fs::File::open(file).unwrap()).unwrap();
        assert_eq!(array, ndarray::arr2(&rows));
    }
}
