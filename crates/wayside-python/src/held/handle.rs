//! A scene that was read, as classes hand it to each other.

use crate::failure;
use crate::given::document::Document;
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
    pub(crate) fn shown(&self) -> Option<&Path> {
        self.document.shown()
    }

    /// The scene through one radar.
    pub(crate) fn opened(&self, py: Python<'_>) -> PyResult<Arc<OpenedScene>> {
        match &self.scene {
            Some(scene) => Ok(Arc::clone(scene)),
            None => opened_by(&self.source, self.memory)
                .map_err(|failure| self.raised(py, &self.document.told(failure))),
        }
    }

    /// Exception of a failure about the scene.
    pub(crate) fn raised(&self, py: Python<'_>, failure: &Failure) -> PyErr {
        raised(py, failure, &self.document, &self.source)
    }
}

/// Reads a scene.
pub(crate) fn opened_by(source: &SceneSource, memory: Allowance) -> Result<Arc<OpenedScene>, Failure> {
    OpenedScene::of(source, memory).map(Arc::new)
}

/// Exception of a failure about a scene: of broken rules all of them, each with its place.
pub(crate) fn raised(py: Python<'_>, failure: &Failure, document: &Document, source: &SceneSource) -> PyErr {
    let faults = scene_faults(source);
    match faults.is_empty() {
        true => failure::raised(py, failure, document.shown()),
        false => failure::of_scene(py, failure, &faults, document.shown()),
    }
}
