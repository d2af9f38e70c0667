//! A scene that is timed: drawn, or a file of anybody's.

use std::path::{Path, PathBuf};
use wayside::host::failure::Failure;
use wayside::host::files;

/// A scene and the threads that it is run on.
pub(super) struct TimedScene {
    pub(super) name: String,
    pub(super) text: Text,
    /// `None`: as many as there are.
    pub(super) threads: Option<u16>,
}

/// Text of a scene, or the place where it stands.
pub(super) enum Text {
    /// Drawn.
    Drawn(String),
    /// A file, beside which stands what it names.
    File(PathBuf),
}

impl TimedScene {
    /// A file of anybody's, on all threads.
    pub(super) fn of_file(file: &Path) -> Self {
        let name = file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        Self { name, text: Text::File(file.to_owned()), threads: None }
    }

    /// The scene's file; of one that was drawn it is written into a folder, a file each: what was read is an
    /// input, and no input is written to.
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
