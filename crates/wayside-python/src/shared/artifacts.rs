//! Artifacts as files, read and written while the interpreter does something else.

use crate::failure;
use artifact::Schema;
use pyo3::prelude::*;
use std::path::Path;
use wayside::stepwise::CompleteArtifact;

/// Reads a complete artifact.
///
/// # Errors
/// The file is missing, of another kind or damaged.
pub(crate) fn read<S>(py: Python<'_>, file: &Path) -> PyResult<CompleteArtifact<S>>
where
    S: Schema<Header: Clone>,
    CompleteArtifact<S>: Send,
{
    let read = py.detach(|| CompleteArtifact::<S>::read(file));
    read.map_err(|failure| failure::exception_of(py, &failure, &[Some(file)]))
}

/// Writes an artifact whole or not at all.
///
/// # Errors
/// The file has the ending of another format; an error of the system.
pub(crate) fn write<S>(py: Python<'_>, recorded: &CompleteArtifact<S>, file: &Path) -> PyResult<()>
where
    S: Schema<Header: Clone>,
    CompleteArtifact<S>: Sync,
{
    let written = py.detach(|| recorded.write(file));
    written.map_err(|failure| failure::exception_of(py, &failure, &[Some(file)]))
}
