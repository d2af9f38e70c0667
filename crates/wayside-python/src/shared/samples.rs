//! Samples of the frames of a cube, which Python holds and the library reads.

use crate::arrays;
use crate::failure;
use crate::shared::values::Values;
use artifact::cube::{Cube as Schema, CubeFrame, CubeHeader};
use artifact::{ErrorBudget, Provenance};
use ndarray::Ix4;
use num_complex::Complex32;
use numpy::PyArray4;
use pyo3::prelude::*;
use wayside::stepwise::{CompleteArtifact, sound};

/// Samples of a cube with all that its artifact says.
pub(crate) struct Samples {
    /// Origin of the samples.
    pub(crate) from: Provenance,
    /// The radar and the settings of its processing.
    pub(crate) header: CubeHeader,
    /// Values `[frame, channel, chirp, sample]`.
    pub(crate) array: Values<Complex32, Ix4>,
    frames: Vec<FrameInfo>,
}

/// A frame without its samples.
struct FrameInfo {
    index: u32,
    time_s: f64,
    error: ErrorBudget,
}

impl Samples {
    /// Hands the samples of a recording over to Python.
    pub(crate) fn of(py: Python<'_>, recorded: CompleteArtifact<Schema>) -> PyResult<Self> {
        let CompleteArtifact { from, header, mut frames } = recorded;
        let [channels, chirps, samples] = header.shape();
        let shape = [frames.len(), channels, chirps, samples];
        let values = match &mut frames[..] {
            [only] => std::mem::take(&mut only.samples),
            several => several.iter_mut().flat_map(|frame| std::mem::take(&mut frame.samples)).collect(),
        };
        let array = arrays::shaped(py, values, shape)?;
        Ok(Self::in_array(CompleteArtifact { from, header, frames }, &array))
    }

    /// Frames as the library takes them; Python may have written samples that no cube has.
    pub(crate) fn frames(&self, py: Python<'_>) -> PyResult<Vec<CubeFrame>> {
        let array = self.array.read(py)?;
        let length = self.header.shape().iter().product::<usize>().max(1);
        let of_frames = self.frames.iter().zip(array.as_slice()?.chunks(length)).enumerate();
        let frame = |(number, (about, samples)): (usize, (&FrameInfo, &[Complex32]))| {
            sound(number, samples, &self.header)
                .map_err(|failure| failure::exception_of(py, &failure, &[]))?;
            let (samples, error) = (samples.to_vec(), about.error);
            Ok(CubeFrame { index: about.index, time_s: about.time_s, samples, error })
        };
        of_frames.map(frame).collect()
    }

    /// Samples that lie in an array of Python already.
    pub(crate) fn in_array(
        recorded: CompleteArtifact<Schema>,
        array: &Bound<'_, PyArray4<Complex32>>,
    ) -> Self {
        let CompleteArtifact { from, header, frames } = recorded;
        let array = Values::of("samples", array);
        Self { from, header, frames: frames.iter().map(frame_info).collect(), array }
    }

    /// Errors of the frames.
    pub(crate) fn errors(&self) -> impl Iterator<Item = &ErrorBudget> {
        self.frames.iter().map(|frame| &frame.error)
    }

    /// Artifact of the samples.
    pub(crate) fn recorded(&self, py: Python<'_>) -> PyResult<CompleteArtifact<Schema>> {
        Ok(CompleteArtifact {
            from: self.from.clone(),
            header: self.header.clone(),
            frames: self.frames(py)?,
        })
    }

    /// Times of the frames' first samples, s.
    pub(crate) fn times_s(&self) -> Vec<f64> {
        self.frames.iter().map(|frame| frame.time_s).collect()
    }
}

fn frame_info(frame: &CubeFrame) -> FrameInfo {
    FrameInfo { index: frame.index, time_s: frame.time_s, error: frame.error }
}
