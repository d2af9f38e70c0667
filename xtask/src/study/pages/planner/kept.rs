//! Rows that an earlier run of the same sources has made: a study that is ended goes on where it was.

use serde::{Serialize, de::DeserializeOwned};
use std::path::PathBuf;
use wayside::host::failure::Failure;
use wayside::host::files;

/// Folder of the rows.
pub(super) struct Kept {
    folder: PathBuf,
}

impl Kept {
    /// Rows of sources with this hash.
    pub(super) fn of(sources: &str) -> Self {
        Self { folder: crate::project::project_root().join("out/study-planner").join(sources) }
    }

    /// The row of this name, or the one that is made now, which is kept.
    pub(super) fn or_made<R: Serialize + DeserializeOwned>(
        &self,
        name: &str,
        make: impl FnOnce() -> Result<R, Failure>,
    ) -> Result<R, Failure> {
        let file = self.folder.join(format!("{name}.json"));
        let read = std::fs::read(&file).ok();
        if let Some(row) = read.and_then(|bytes| serde_json::from_slice(&bytes).ok()) {
            return Ok(row);
        }
        let row = make()?;
        let text = serde_json::to_vec(&row).map_err(|error| Failure::System(error.to_string()))?;
        files::write_again(&file, &text)?;
        Ok(row)
    }
}
