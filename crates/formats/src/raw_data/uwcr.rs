//! Raw frames of the University of Washington: one `.mat` per frame, `[sample, chirp, receiver,
//! transmitter]`.

use crate::mat_file::{self, MatError};
use crate::raw_data::{ImportedFrames, IntegerStep, LIMIT_BYTES};
use artifact::bounded;
use artifact::cube::CubeHeader;
use num_complex::Complex32;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use std::path::{Path, PathBuf};

/// Ending of a frame's file.
pub const ENDINGS: [&str; 1] = ["mat"];

/// Name of the array in each file.
pub(crate) const ARRAY: &str = "adcData";

/// Samples, chirps, receivers, and transmitters or the slots of their codes: a cube's axes reversed, so that
/// its values are already in the order of a column-major array.
pub(crate) fn shape(header: &CubeHeader) -> [usize; 4] {
    let [channels, chirps, samples] = header.shape();
    let receivers = header.radar.array.rx_m.len().max(1);
    [samples, chirps, receivers, channels / receivers]
}

/// Reads the frames of files, one each, in their order.
///
/// # Errors
/// Files that are not such arrays, or do not have the sizes of the header's radar.
pub fn read(files: &[PathBuf], header: &CubeHeader) -> Result<ImportedFrames, Failure> {
    let counted = progress::counted("frames", files, files.len());
    let frames: Result<Vec<_>, _> = counted.map(|file| of_file(file, header)).collect();
    Ok(ImportedFrames { frames: frames?, step: IntegerStep::Floats })
}

fn of_file(file: &Path, header: &CubeHeader) -> Result<Vec<Complex32>, Failure> {
    let bytes = bounded::read(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
    let refused = |why: MatError| Failure::Refused(format!("{}: {why}", file.display()));
    mat_file::complex_values(&bytes, shape(header)).map_err(refused)
}
