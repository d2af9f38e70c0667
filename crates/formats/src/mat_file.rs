//! MATLAB's level 5 files (`.mat` of versions 5 to 7; MathWorks, "MAT-File Format"), restricted to one
//! complex array of numbers.
//!
//! A file is a head of 128 bytes and elements: a tag of type and length, and that many bytes, padded to 8. An
//! array is an element of elements: class and flags, sides, name, real parts, imaginary parts, column-major.
//! An element of type 15 is another one compressed by zlib.

mod write;
mod mat_error;
mod read;

pub(crate) use mat_error::MatError;
pub(crate) use read::complex_values;
pub(crate) use write::ComplexArray;

/// Bytes of the head.
const HEAD_BYTES: usize = 128;
/// Types of elements.
const INT8: u32 = 1;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const SINGLE: u32 = 7;
const MATRIX: u32 = 14;
const COMPRESSED: u32 = 15;
/// Flag of an array with imaginary parts.
const COMPLEX: u32 = 0x0800;
