//! Frames of an artifact in memory, with its header and provenance.

use crate::stepwise::extensions;
use artifact::{ErrorBudget, ModelError, Provenance, Reader, Schema, Writer};
use pipeline::host::failure::Failure;
use pipeline::outcome::error_figures::{ErrorFigures, ModelErrorFigures};
use std::path::Path;

/// A complete artifact in memory.
pub struct CompleteArtifact<S: Schema> {
    /// Provenance of the frames.
    pub from: Provenance,
    /// Header, common to all frames.
    pub header: S::Header,
    /// Frames in order.
    pub frames: Vec<S::Frame>,
}

impl<S: Schema<Header: Clone>> CompleteArtifact<S> {
    /// Reads a complete artifact.
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
    /// The file has the ending of another format; an error of the system.
    pub fn write(&self, file: &Path) -> Result<(), Failure> {
        extensions::check(file, S::NAME)?;
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
