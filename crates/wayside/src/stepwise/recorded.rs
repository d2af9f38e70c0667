//! Frames of an artifact in memory, with all that its file says.

use crate::stepwise::endings;
use artifact::{ErrorBudget, ModelError, Provenance, Reader, Schema, Writer};
use pipeline::host::failure::Failure;
use pipeline::outcome::error_figures::{ErrorFigures, ModelErrorFigures};
use std::path::Path;

/// An artifact whole in memory.
pub struct Recorded<S: Schema> {
    /// Origin of the frames.
    pub from: Provenance,
    /// Header, common to all frames.
    pub header: S::Header,
    /// Frames in their order.
    pub frames: Vec<S::Frame>,
}

impl<S: Schema<Header: Clone>> Recorded<S> {
    /// Reads an artifact whole.
    ///
    /// # Errors
    /// The file is missing, of another kind or damaged.
    pub fn read(file: &Path) -> Result<Self, Failure> {
        let reader = Reader::<S>::open(file)?;
        let from = reader.preamble().provenance.clone();
        let header = reader.header().clone();
        let frames = reader.collect::<Result<Vec<_>, _>>()?;
        Ok(Self { from, header, frames })
    }

    /// Writes the artifact whole or not at all.
    ///
    /// # Errors
    /// A file with the ending of another format; the system's.
    pub fn write(&self, file: &Path) -> Result<(), Failure> {
        endings::check(file, S::NAME)?;
        let mut writer = Writer::<S>::create(file, &self.from, &self.header)?;
        self.frames.iter().try_for_each(|frame| writer.write(frame))?;
        Ok(writer.finish()?)
    }
}

/// Numerical errors in dB relative to the echo.
pub fn error_figures(error: &ErrorBudget) -> ErrorFigures {
    ErrorFigures::of(error)
}

/// Errors of the model in dB relative to the echo.
pub fn model_error_figures(error: &ModelError) -> ModelErrorFigures {
    ModelErrorFigures::of(error)
}
