//! Runs of scenes from their texts, in a folder that lasts as long as they do.

use std::path::PathBuf;
use wayside::host::failure::Failure;
use wayside::host::files;
use wayside::{CacheLocation, Outcome, Settings, Summary};

/// Folder of scenes and of a cache of its own, from which runs with other noise or other processing take
/// their paths: frames that an earlier study has left would cost no seconds.
pub(in crate::study::pages) struct RunFolder {
    folder: tempfile::TempDir,
}

impl RunFolder {
    pub(in crate::study::pages) fn new() -> Result<Self, Failure> {
        let folder = tempfile::tempdir().map_err(|e| Failure::System(format!("no temporary folder: {e}")))?;
        Ok(Self { folder })
    }

    /// File of a scene and the outcome of its run, with settings that `change` may change. Each run has a
    /// name of its own; artifacts and pictures, gigabytes of a minute of traffic, are removed.
    pub(in crate::study::pages) fn outcome(
        &self,
        name: &str,
        text: &str,
        change: impl FnOnce(&mut Settings),
    ) -> Result<(PathBuf, Outcome), Failure> {
        let place = |name: &str| self.folder.path().join(name);
        // A separate file for each run: files that were read are never written.
        let (file, out) = (place(&format!("{name}.toml")), place(name));
        files::write_file(&file, text.as_bytes())?;
        let cache = CacheLocation { folder: Some(place("cache")), ..CacheLocation::default() };
        let mut settings = Settings { cache: Some(cache), ..Settings::of(&file, &out) };
        change(&mut settings);
        let outcome = wayside::run(&settings)?;
        std::fs::remove_dir_all(&out).map_err(|e| Failure::system(&out, "remove", e))?;
        Ok((file, outcome))
    }

    /// Summary of the run of a scene with one radar.
    pub(in crate::study::pages) fn summary(
        &self,
        name: &str,
        text: &str,
        change: impl FnOnce(&mut Settings),
    ) -> Result<Summary, Failure> {
        let (file, outcome) = self.outcome(name, text, change)?;
        let several = || Failure::Refused(format!("{}: has several radars", file.display()));
        outcome.summary().cloned().ok_or_else(several)
    }
}
