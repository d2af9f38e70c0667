//! The folder of a dataset: complete under its name, or absent.
//!
//! Its own description, `set.json`, is one of its files.

use artifact::atomic_file::AtomicFolder;
use artifact::{Reader, Schema};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Name of the description in the folder.
pub(crate) const DESCRIPTION: &str = "set.json";

/// A folder being filled; dropped before [`Self::finish`], it leaves nothing.
pub(crate) struct SetFolder {
    whole: AtomicFolder,
    /// Number of the current frame.
    frame: Option<u32>,
}

impl SetFolder {
    /// Begins to fill the future folder `out`, which must be missing or empty.
    ///
    /// # Errors
    /// The folder is not empty, is no folder, or nothing can be written beside it.
    pub(crate) fn begin(out: &Path) -> Result<Self, Failure> {
        Ok(Self { whole: AtomicFolder::create(out)?, frame: None })
    }

    /// Writes the frames of an artifact, one after the other, and returns their number.
    ///
    /// # Errors
    /// A frame is damaged, does not come after the one before it, or cannot be written.
    pub(crate) fn each_frame<S: Schema>(
        &mut self,
        reader: Reader<S>,
        index_of: fn(&S::Frame) -> u32,
        mut write: impl FnMut(&Self, S::Frame) -> Result<(), Failure>,
    ) -> Result<usize, Failure> {
        let mut written = 0;
        for frame in progress::frames(reader) {
            let frame = frame?;
            self.begin_frame(index_of(&frame))?;
            write(self, frame)?;
            written += 1;
        }
        Ok(written)
    }

    /// Begins a frame, whose files have its number.
    ///
    /// # Errors
    /// The frame does not come after the one before it.
    fn begin_frame(&mut self, index: u32) -> Result<(), Failure> {
        match self.frame.replace(index) {
            Some(before) if before >= index => {
                Err(Failure::refused(format!("frame {index} follows frame {before}: they are not in order")))
            }
            _ => Ok(()),
        }
    }

    /// Place of a file while the folder is being filled.
    pub(crate) fn place(&self, name: &str) -> PathBuf {
        self.whole.path().join(name)
    }

    /// Writes a file; creates folders above it.
    pub(crate) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        files::write_file(&self.place(name), bytes)
    }

    /// Writes a file of JSON.
    pub(crate) fn write_json(&self, name: &str, value: &Value) -> Result<(), Failure> {
        let text = serde_json::to_string_pretty(value).map_err(Failure::refused)?;
        self.write(name, text.as_bytes())
    }

    /// Writes the description and gives the folder its name.
    pub(crate) fn finish(self, description: &Value) -> Result<(), Failure> {
        self.write_json(DESCRIPTION, description)?;
        Ok(self.whole.finish()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_set_is_there_whole_or_not_at_all_and_never_over_anything() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("new/set");
        let set = SetFolder::begin(&out).unwrap();
        set.write("a/b.txt", b"b").unwrap();
        assert!(!out.exists());
        drop(set);
        assert_eq!(std::fs::read_dir(folder.path().join("new")).unwrap().count(), 0);
        let mut set = SetFolder::begin(&out).unwrap();
        set.begin_frame(3).unwrap();
        assert!(set.begin_frame(3).is_err_and(|e| e.to_string().contains("not in order")));
        set.write("a/b.txt", b"b").unwrap();
        set.finish(&json!({})).unwrap();
        assert_eq!(std::fs::read(out.join("a/b.txt")).unwrap(), b"b");
        assert!(out.join(DESCRIPTION).is_file());
        assert!(SetFolder::begin(&out).is_err_and(|e| e.to_string().contains("not empty")));
        std::fs::write(folder.path().join("file"), b"").unwrap();
        assert!(SetFolder::begin(&folder.path().join("file")).is_err());
    }
}
