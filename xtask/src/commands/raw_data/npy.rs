//! NumPy's `.npy` of complex64 in a cube's shape: its header is read here, so that no size that a file claims is believed
//! before it is compared with what the file has and the scene's radar makes.

use super::{Frames, refused, stream};
use crate::failure::Failure;
use artifact::bounded;
use num_complex::Complex32;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

/// A dictionary of three entries takes some hundred bytes; NumPy itself refuses more than 10,000.
const HEADER_LIMIT: usize = 1 << 16;

/// What the header says.
#[derive(Debug, PartialEq, Eq)]
struct Header {
    shape: Vec<usize>,
    order: Order,
}

/// Which index runs fastest.
#[derive(Debug, PartialEq, Eq)]
enum Order {
    /// The last.
    C,
    /// The first.
    Fortran,
}

/// Frames of complex64 in the shape [frame, channel, chirp, sample].
pub(crate) fn read(file: &Path, [channels, chirps, samples]: [usize; 3]) -> Result<Frames, Failure> {
    let rule = "a .npy of complex64 in the shape [frame, channel, chirp, sample] is needed";
    let no_such = |what: &str| refused(file, format!("{what}: {rule}"));
    let mut handle = BufReader::new(bounded::open(file).map_err(|e| Failure::system(file, "open", e))?);
    let (header, header_bytes) = header(&mut handle).map_err(|what| no_such(&what))?;
    let [frames, found @ ..] = header.shape[..] else { return Err(no_such("it has no dimension")) };
    let told = handle.get_ref().metadata().map_err(|e| Failure::system(file, "read", e))?.len();
    let shape = [channels, chirps, samples];
    if found.len() != 3 {
        return Err(no_such(&format!("it has {} dimensions", header.shape.len())));
    }
    if found != shape {
        let text = format!("[channel, chirp, sample] is {found:?}, the scene's radar has {shape:?}");
        return Err(refused(file, text));
    }
    let values = channels * chirps * samples;
    let needed = (frames as u64).checked_mul(8 * values as u64).and_then(|bytes| bytes.checked_add(header_bytes));
    if frames == 0 || needed != Some(told) {
        return Err(no_such(&format!("it has {told} bytes, which are not its header and {frames} frames")));
    }
    match header.order {
        Order::C => Ok(stream(file, handle, frames, 8 * values, |bytes| complex(bytes))),
        Order::Fortran => of_fortran(file, handle, frames, values),
    }
}
