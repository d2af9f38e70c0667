//! Class `Paths`: the paths of all frames of a scene.

use crate::paths_frame::PathsFrame;
use crate::shared::artifacts;
use artifact::paths::Paths as Schema;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use wayside::stepwise::CompleteArtifact;

/// Scattering paths of the frames of a scene: a sequence of `PathsFrame`.
#[pyclass(frozen, module = "wayside")]
pub(crate) struct Paths {
    /// The artifact, which its frames share.
    pub(crate) all: Arc<CompleteArtifact<Schema>>,
}

#[pymethods]
impl Paths {
    /// Reads a `.paths` artifact.
    #[staticmethod]
    #[pyo3(signature = (file))]
    fn read(py: Python<'_>, file: PathBuf) -> PyResult<Self> {
        Ok(Self { all: Arc::new(artifacts::read(py, &file)?) })
    }

    /// Writes a `.paths` artifact, the bytes of `wayside paths`; another format's ending is refused.
    #[pyo3(signature = (file))]
    fn write(&self, py: Python<'_>, file: PathBuf) -> PyResult<()> {
        artifacts::write(py, &self.all, &file)
    }

    /// Ids of the scene's targets.
    #[getter]
    fn targets(&self) -> Vec<String> {
        self.all.header.targets.clone()
    }

    /// Frequency f_c of the amplitudes, Hz: the centre of the sampled sweep.
    #[getter]
    fn centre_frequency_hz(&self) -> f64 {
        self.all.header.centre_frequency_hz
    }

    /// Table of all paths, a row each: `pandas.DataFrame`, where pandas is installed.
    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("wayside.tables")?.call_method1("paths_to_pandas", (slf,))
    }

    fn __len__(&self) -> usize {
        self.all.frames.len()
    }

    fn __getitem__(&self, index: isize) -> PyResult<PathsFrame> {
        let count = self.all.frames.len() as isize;
        let at = if index < 0 { index + count } else { index };
        match (0..count).contains(&at) {
            true => Ok(PathsFrame::of(Arc::clone(&self.all), at as usize)),
            false => Err(PyIndexError::new_err(format!("frame {index} of {count}"))),
        }
    }

    fn __repr__(&self) -> String {
        let paths: usize = self.all.frames.iter().map(|frame| frame.paths.len()).sum();
        format!("<wayside.Paths: {} frames, {paths} paths>", self.all.frames.len())
    }
}
