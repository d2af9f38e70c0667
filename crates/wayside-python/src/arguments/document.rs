//! A scene as Python names it: the path of a TOML file, or a dictionary with the same keys.

use crate::failure;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use wayside::Failure;

/// The document of a scene, where the library reads it.
pub(crate) struct Document {
    /// The TOML file.
    pub(crate) file: PathBuf,
    /// Text of a dictionary as TOML, in a folder that ends with the document; `None` of a file.
    kept: Option<TempDir>,
}

impl Document {
    /// Takes a path as it is; of a dictionary a file of TOML is made, in which files are named by whole paths
    /// from `folder` on.
    pub(crate) fn of(source: &Bound<'_, PyAny>, folder: Option<PathBuf>) -> PyResult<Self> {
        let py = source.py();
        let mapping = py.import("collections.abc")?.getattr("Mapping")?;
        if !source.is_instance(&mapping)? {
            return Ok(Self { file: source.extract()?, kept: None });
        }
        let words = PyDict::new(py);
        words.set_item("folder", folder)?;
        let text = py.import("wayside.document")?.call_method("toml_of", (source,), Some(&words))?;
        let kept = TempDir::with_prefix("wayside-")?;
        let file = kept.path().join("scene.toml");
        std::fs::write(&file, text.extract::<String>()?)?;
        Ok(Self { file, kept: Some(kept) })
    }

    /// Name by which a sentence of a failure calls the scene.
    fn name(&self) -> &Path {
        self.message_path().unwrap_or(Path::new("scene"))
    }

    /// A failure that names the scene as the user does, who knows no file of a dictionary.
    pub(crate) fn named_failure(&self, failure: Failure) -> Failure {
        let failure = failure.about(self.name());
        let own = self.file.display().to_string();
        let text = |text: String| if self.kept.is_some() { text.replace(&own, "scene") } else { text };
        match failure {
            Failure::Refused(told) => Failure::Refused(text(told)),
            Failure::Unplaced(told) => Failure::Unplaced(text(told)),
            Failure::System(told) => Failure::System(text(told)),
            Failure::Cancelled => Failure::Cancelled,
        }
    }

    /// The file that messages name; `None` of a dictionary.
    pub(crate) fn message_path(&self) -> Option<&Path> {
        self.kept.is_none().then_some(self.file.as_path())
    }
}

/// An accuracy within what the command line takes, which begins at `allowed` and ends below 0 dB.
pub(crate) fn accuracy_db(db: f64, allowed: &RangeInclusive<f64>) -> PyResult<f64> {
    let least = allowed.start();
    match (*least..0.0).contains(&db) {
        true => Ok(db),
        false => Err(failure::argument_error("accuracy_db", format!("from {least} to below 0, is {db}"))),
    }
}

/// Names of the keys of a scene that name files, which are sought beside the scene.
#[pyfunction]
pub(crate) fn file_keys() -> Vec<&'static str> {
    wayside::stepwise::file_keys().into_iter().collect()
}
