//! Frames of NumPy arrays: samples in a cube's shape, or range–azimuth–Doppler tensors.

use crate::raw_data::raddet::TensorInverse;
use crate::raw_data::{ImportedFrames, IntegerStep, LIMIT_BYTES, described_unit, described_waveform, npy};
use crate::sidecar;
use artifact::bounded;
use artifact::cube::CubeHeader;
use ndarray::{ArrayD, Axis};
use num_complex::Complex32;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Ending of an array's file.
pub const ENDINGS: [&str; 1] = ["npy"];

/// Axes of samples, as the description of an exported cube names them.
pub(crate) const AXES: [&str; 4] = ["frame", "channel", "chirp", "sample"];
/// Key of the frames' times in that description.
pub(crate) const FRAME_TIMES: &str = "frame_times_s";

/// Reads the frames of files in their order: four axes are `[frame, channel, chirp, sample]`, in the unit
/// that the `.json` beside a file gives, three a tensor of RADDet, which is one frame. The waveform in that
/// `.json` must be the radar's.
///
/// # Errors
/// Files that are not such arrays, do not have the sizes of the header's radar, or are of different kinds or
/// units; descriptions of another radar.
pub fn read(files: &[PathBuf], header: &CubeHeader) -> Result<ImportedFrames, Failure> {
    let mut imported = ImportedFrames { frames: vec![], step: IntegerStep::Floats, descriptions: vec![] };
    let mut inverse = None;
    for (index, file) in progress::counted("frames", files, files.len()).enumerate() {
        let array = values(file)?;
        let step = meaning(&array, file, header)?;
        if index == 0 {
            imported.step = step.clone();
        }
        check_alike(&step, &imported.step).map_err(|failure| failure.about(file))?;
        if let IntegerStep::DescribedFloats(_, place) = step {
            imported.descriptions.push(place);
        }
        let frames = match is_of_samples(&array) {
            true => frames_of_samples(&array, header.shape()),
            false => planned(&mut inverse, header)
                .and_then(|inverse| inverse.samples(&array, index))
                .map(|frame| vec![frame]),
        };
        imported.frames.extend(frames.map_err(|failure| failure.about(file))?);
    }
    Ok(imported)
}

/// Descriptions beside files, whatever they describe.
pub fn descriptions(files: &[PathBuf]) -> Vec<PathBuf> {
    files.iter().map(|file| sidecar::beside(file)).filter(|place| place.is_file()).collect()
}

/// The inverse of the radar's tensors, planned at the first of them.
fn planned<'a>(
    inverse: &'a mut Option<TensorInverse>,
    header: &CubeHeader,
) -> Result<&'a TensorInverse, Failure> {
    let planned = inverse.take().map_or_else(|| TensorInverse::new(header), Ok)?;
    Ok(inverse.insert(planned))
}

fn is_of_samples(array: &ArrayD<Complex32>) -> bool {
    array.ndim() == AXES.len()
}

/// Meaning of an array's values; a description of another radar is refused.
fn meaning(array: &ArrayD<Complex32>, file: &Path, header: &CubeHeader) -> Result<IntegerStep, Failure> {
    if !is_of_samples(array) {
        return Ok(IntegerStep::Unscaled);
    }
    let Some((told, place)) = description_of(file, array.shape()[0]) else { return Ok(IntegerStep::Floats) };
    described_waveform::OWN_KEYS.check(&told, &place, &header.radar.waveform)?;
    described_unit::OWN_KEYS.meaning(&told, &place)
}

/// The description beside an array, and its place, if it is one of so many frames of samples.
fn description_of(file: &Path, frames: usize) -> Option<(Value, PathBuf)> {
    let place = sidecar::beside(file);
    let told = sidecar::read(&place)?;
    let has_frames = told[FRAME_TIMES].as_array().is_some_and(|times| times.len() == frames);
    (told["shape"] == json!(AXES) && has_frames).then_some((told, place))
}

/// Refuses a file of another kind, or in another unit, than the first in its folder.
fn check_alike(step: &IntegerStep, first: &IntegerStep) -> Result<(), Failure> {
    let unit = |step: &IntegerStep| match step {
        IntegerStep::DescribedFloats(unit, _) => Some(*unit),
        _ => None,
    };
    let words = |step: &IntegerStep| {
        unit(step)
            .map_or_else(|| "in a unit that no file gives".to_owned(), |unit| format!("in {}", unit.words()))
    };
    let axes = |step: &IntegerStep| if *step == IntegerStep::Unscaled { 3 } else { AXES.len() };
    if axes(step) != axes(first) {
        let rule = format!("has {} axes, as the first file in its folder has not", axes(step));
        return Err(Failure::refused(rule));
    }
    match unit(step) == unit(first) {
        true => Ok(()),
        false => {
            let rule = format!("samples are {}, those of the first file in its folder", words(step));
            Err(Failure::refused(format!("{rule} {}", words(first))))
        }
    }
}

fn values(file: &Path) -> Result<ArrayD<Complex32>, Failure> {
    let bytes = bounded::read(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
    let rule = "a .npy of complex64 in the shape [frame, channel, chirp, sample] is needed, or a tensor \
                [range, azimuth, Doppler]";
    let refused = |why: npy::NpyError| Failure::Refused(format!("{}: {why}: {rule}", file.display()));
    npy::of_bytes(&bytes, AXES.len() - 1..=AXES.len()).map_err(refused)
}

fn frames_of_samples(array: &ArrayD<Complex32>, shape: [usize; 3]) -> Result<Vec<Vec<Complex32>>, Failure> {
    let found = &array.shape()[1..];
    if found != shape {
        let text = format!("[channel, chirp, sample] is {found:?}, the scene's radar has {shape:?}");
        return Err(Failure::refused(text));
    }
    Ok(array.axis_iter(Axis(0)).map(|frame| frame.iter().copied().collect()).collect())
}
