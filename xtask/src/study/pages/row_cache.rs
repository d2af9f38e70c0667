//! Rows made by an earlier run of the same sources: an interrupted study resumes.

use serde::{Serialize, de::DeserializeOwned};
use std::path::PathBuf;
use wayside::host::failure::Failure;
use wayside::host::files;

/// Folder of the rows.
pub(in crate::study) struct RowCache {
    folder: PathBuf,
}

impl RowCache {
    /// Rows of a study with this hash of sources.
    pub(in crate::study) fn of(study: &str, sources: &str) -> Self {
        let folder = crate::project::project_root().join(format!("out/study-{study}"));
        Self { folder: folder.join(sources) }
    }

    /// The row with this name, if it was made.
    pub(in crate::study) fn get<R: DeserializeOwned>(&self, name: &str) -> Option<R> {
        serde_json::from_slice(&std::fs::read(self.file(name)).ok()?).ok()
    }

    /// Number of rows with these names that were not made.
    pub(in crate::study) fn missing<R: DeserializeOwned>(
        &self,
        names: impl Iterator<Item = String>,
    ) -> usize {
        names.filter(|name| self.get::<R>(name).is_none()).count()
    }

    /// The row with this name, or a new one, which is kept.
    pub(in crate::study) fn get_or_make<R: Serialize + DeserializeOwned>(
        &self,
        name: &str,
        make: impl FnOnce() -> Result<R, Failure>,
    ) -> Result<R, Failure> {
        if let Some(row) = self.get(name) {
            return Ok(row);
        }
        let row = make()?;
        let text = serde_json::to_vec(&row).map_err(|error| Failure::System(error.to_string()))?;
        files::overwrite(&self.file(name), &text)?;
        Ok(row)
    }

    fn file(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{name}.json"))
    }
}
