//! A scene that was read, as classes hand it to each other.

use crate::arguments::document::Document;
use crate::failure;
use crate::shared::source_files::SourceFiles;
use pyo3::prelude::*;
use std::path::Path;
use std::sync::Arc;
use wayside::host::memory::Allowance;
use wayside::stepwise::{OpenedScene, scene_faults};
use wayside::{Failure, SceneSource};

/// A scene and where it came from; Python sees it as `Scene`.
#[pyclass(frozen)]
pub(crate) struct Handle {
    /// The document of the scene.
    pub(crate) document: Arc<Document>,
    /// The document, and what replaces parts of it.
    pub(crate) source: SceneSource,
    /// Memory that tracing may take.
    pub(crate) memory: Allowance,
    /// Files that it was read from.
    pub(crate) source_files: SourceFiles,
    /// The scene through its radar; `None` where it has several and none was asked for.
    pub(crate) scene: Option<Arc<OpenedScene>>,
}

impl Handle {
    /// The handle of a scene, or of a path or a dictionary.
    pub(crate) fn of_any<'py>(scene: &Bound<'py, PyAny>) -> PyResult<Bound<'py, Self>> {
        let class = scene.py().import("wayside")?.getattr("Scene")?;
        let made = if scene.is_instance(&class)? { scene.clone() } else { class.call1((scene,))? };
        Ok(made.getattr("_handle")?.cast_into()?)
    }

    /// File that messages name; `None` of a dictionary.
    pub(crate) fn message_path(&self) -> Option<&Path> {
        self.document.message_path()
    }

    /// The scene through one radar.
    pub(crate) fn opened(&self, py: Python<'_>) -> PyResult<Arc<OpenedScene>> {
        match &self.scene {
            Some(scene) => Ok(Arc::clone(scene)),
            None => {
                let source = self.source_again(py)?;
                let refused = |failure| {
                    scene_source_exception(py, &self.document.named_failure(failure), &self.document, &source)
                };
                opened_by(&source, self.memory).map_err(refused)
            }
        }
    }

    /// The source, whose files are still those that the scene was read from.
    pub(crate) fn source_again(&self, py: Python<'_>) -> PyResult<SceneSource> {
        let source = self.source_files.seen_from_here(&self.source);
        let checked = py.detach(|| self.source_files.check(&source));
        checked.map_err(|failure| {
            scene_source_exception(py, &self.document.named_failure(failure), &self.document, &source)
        })?;
        Ok(source)
    }
}

/// Reads a scene.
pub(crate) fn opened_by(source: &SceneSource, memory: Allowance) -> Result<Arc<OpenedScene>, Failure> {
    OpenedScene::of(source, memory).map(Arc::new)
}

/// Exception of a failure about a scene: of broken rules all of them, each with its place.
pub(crate) fn scene_source_exception(
    py: Python<'_>,
    failure: &Failure,
    document: &Document,
    source: &SceneSource,
) -> PyErr {
    let faults = scene_faults(source);
    match faults.is_empty() {
        true => failure::exception_of(py, failure, &[document.message_path()]),
        false => failure::scene_exception(py, failure, &faults, document.message_path()),
    }
}
