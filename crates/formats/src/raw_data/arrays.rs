//! Frames of NumPy arrays: samples in a cube's shape, or range–azimuth–Doppler tensors.

use crate::raw_data::raddet::TensorInverse;
use crate::raw_data::{ImportedFrames, IntegerStep, LIMIT_BYTES, npy};
use artifact::bounded;
use artifact::cube::CubeHeader;
use ndarray::{ArrayD, Axis};
use num_complex::Complex32;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use std::path::{Path, PathBuf};

/// Ending of an array's file.
pub const ENDINGS: [&str; 1] = ["npy"];

/// Axes of samples: frame, channel, chirp, sample.
const AXES: usize = 4;

/// Reads the frames of files in their order: four axes are `[frame, channel, chirp, sample]`, three a tensor
/// of RADDet, which is one frame.
///
/// # Errors
/// Files that are not such arrays, do not have the sizes of the header's radar, or are of different kinds.
pub fn read(files: &[PathBuf], header: &CubeHeader) -> Result<ImportedFrames, Failure> {
    let mut imported = ImportedFrames { frames: vec![], step: IntegerStep::Floats };
    let mut inverse = None;
    for (index, file) in progress::counted("frames", files, files.len()).enumerate() {
        let array = values(file)?;
        let step = step_of(&array);
        if index > 0 && step != imported.step {
            let rule = format!("has {} axes, as the first file in its folder has not", array.ndim());
            return Err(Failure::Refused(format!("{}: {rule}", file.display())));
        }
        imported.step = step;
        let frames = match array.ndim() {
            AXES => frames_of_samples(&array, header.shape()),
            _ => planned(&mut inverse, header)
                .and_then(|inverse| inverse.samples(&array, index))
                .map(|frame| vec![frame]),
        };
        imported.frames.extend(frames.map_err(|failure| failure.about(file))?);
    }
    Ok(imported)
}

/// The inverse of the radar's tensors, planned at the first of them.
fn planned<'a>(
    inverse: &'a mut Option<TensorInverse>,
    header: &CubeHeader,
) -> Result<&'a TensorInverse, Failure> {
    let planned = inverse.take().map_or_else(|| TensorInverse::new(header), Ok)?;
    Ok(inverse.insert(planned))
}

fn step_of(array: &ArrayD<Complex32>) -> IntegerStep {
    if array.ndim() == AXES { IntegerStep::Floats } else { IntegerStep::Unscaled }
}

fn values(file: &Path) -> Result<ArrayD<Complex32>, Failure> {
    let bytes = bounded::read(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
    let rule = "a .npy of complex64 in the shape [frame, channel, chirp, sample] is needed, or a tensor \
                [range, azimuth, Doppler]";
    let refused = |why: npy::NpyError| Failure::Refused(format!("{}: {why}: {rule}", file.display()));
    npy::of_bytes(&bytes, AXES - 1..=AXES).map_err(refused)
}

fn frames_of_samples(array: &ArrayD<Complex32>, shape: [usize; 3]) -> Result<Vec<Vec<Complex32>>, Failure> {
    let found = &array.shape()[1..];
    if found != shape {
        let text = format!("[channel, chirp, sample] is {found:?}, the scene's radar has {shape:?}");
        return Err(Failure::refused(text));
    }
    Ok(array.axis_iter(Axis(0)).map(|frame| frame.iter().copied().collect()).collect())
}
