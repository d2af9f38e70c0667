//! A scene to time: drawn, or any file.

use std::path::{Path, PathBuf};
use wayside::host::failure::Failure;
use wayside::host::files;

/// A scene with the number of threads to run it.
pub(super) struct TimedScene {
    pub(super) name: String,
    pub(super) text: Text,
    /// `None`: as many as there are.
    pub(super) threads: Option<u16>,
}

/// Text of a scene, or its place.
pub(super) enum Text {
    /// Drawn.
    Drawn(String),
    /// A file, beside the files that it names.
    File(PathBuf),
}

impl TimedScene {
    /// Any scene file, on all threads.
    pub(super) fn of_file(file: &Path) -> Self {
        let name = file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        Self { name, text: Text::File(file.to_owned()), threads: None }
    }

    /// The scene's file; a drawn scene is written into a folder, one file each: files that were read are
    /// inputs, and inputs are never written.
    pub(super) fn file(&self, folder: &Path) -> Result<PathBuf, Failure> {
        match &self.text {
            Text::Drawn(text) => {
                let file = folder.join(format!("{}.toml", self.name));
                files::write_file(&file, text.as_bytes())?;
                Ok(file)
            }
            Text::File(file) => Ok(file.clone()),
        }
    }
}
