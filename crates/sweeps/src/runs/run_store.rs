//! Kept runs: one file each under the hash of all its inputs, so that a study resumes where it was ended,
//! reuses the runs of another study in the same folder, and can be made in parts.

use crate::metrics::VERSION;
use crate::runs::ledger::Run;
use crate::runs::run_accuracy::RunAccuracy;
use crate::study::document::Study;
use artifact::changed_inputs::HashedFile;
use artifact::envelope::fingerprint;
use pipeline::chain::loading;
use pipeline::chain::stages::{SOURCES_OF_EVALUATION, Stage};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use scene::{Change, ReadOptions};
use serde::Deserialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Largest run file; a run is a line of some numbers.
const LIMIT_BYTES: u64 = 1 << 20;

/// Folder of a study's runs.
pub(crate) struct RunStore {
    folder: PathBuf,
    /// Hash of the common inputs of all runs of this study.
    common: String,
    /// Files that keys were made from so far, in their state at that time.
    seen: Mutex<BTreeMap<PathBuf, HashedFile>>,
}

impl RunStore {
    /// Folder of the runs within that of a study's results.
    pub(crate) fn folder_in(out: &Path) -> PathBuf {
        out.join("runs")
    }

    /// Runs of a study with a classifier's model of this hash, in the folder of its results.
    pub(crate) fn of(study: &Study, model: Option<&str>, out: &Path) -> Self {
        let sources: Vec<&str> = Stage::ALL.iter().map(|stage| stage.sources()).collect();
        let names: Vec<&str> = study.metrics.names().collect();
        let common = fingerprint(&(VERSION, sources, SOURCES_OF_EVALUATION, names, model, &study.radar));
        Self { folder: Self::folder_in(out), common, seen: Mutex::default() }
    }

    /// Hash of all inputs of a run: its changes, and those of the run in which its errors are measured.
    pub(crate) fn key(
        &self,
        study: &Study,
        [changes, measured_in]: [&[Change]; 2],
        seed: u64,
    ) -> Result<String, Failure> {
        let options = ReadOptions { radar: study.radar.clone(), ..ReadOptions::names_only() };
        let files =
            scene::inputs_of_changed(&study.scene, changes, &options).map_err(loading::scene_failure)?;
        let hashes = files.iter().map(|file| self.hash(file)).collect::<Result<Vec<_>, _>>()?;
        let pairs = |changes: &[Change]| {
            changes.iter().map(|c| (c.key.clone(), c.value.clone())).collect::<Vec<(String, String)>>()
        };
        Ok(fingerprint(&(&self.common, hashes, pairs(changes), pairs(measured_in), seed)))
    }

    fn hash(&self, file: &Path) -> Result<String, Failure> {
        let mut known = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(seen) = known.get(file) {
            return Ok(seen.named().1.clone());
        }
        let seen = HashedFile::of(file).map_err(|error| Failure::system(file, "read", error))?;
        let hash = seen.named().1.clone();
        known.insert(file.to_owned(), seen);
        Ok(hash)
    }

    /// Refuses to continue if a file that keys were made from has changed since: a run may then belong to
    /// another scene than its key indicates.
    ///
    /// # Errors
    /// A file has changed.
    pub(crate) fn check_unchanged(&self) -> Result<(), Failure> {
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        loading::check_unchanged(seen.values_mut())
    }

    /// Reads an earlier run; `None` if its file is missing or incomplete.
    pub(crate) fn get(&self, study: &Study, key: &str) -> Option<Run> {
        // Earlier versions had folders of two letters.
        let read = |file: &Path| files::read_own(file, LIMIT_BYTES);
        let text = read(&self.file(key)).or_else(|_| read(&self.file_below(key, 2))).ok()?;
        let run: Value = serde_json::from_slice(&text).ok()?;
        let metrics = run["metrics"].as_object().filter(|_| run["key"] == key)?;
        let value = |name: &str| match metrics.get(name)? {
            Value::Null => Some(None),
            value => value.as_f64().map(Some),
        };
        // Earlier versions kept no accuracy, or did not record in which run the errors were measured.
        let accuracy = run.get("accuracy").and_then(|accuracy| RunAccuracy::deserialize(accuracy).ok());
        let accuracy = accuracy.unwrap_or_default();
        Some(Run { values: study.metrics.names().map(value).collect::<Option<_>>()?, accuracy })
    }

    /// Keeps a run, whole or not at all.
    pub(crate) fn put(&self, study: &Study, key: &str, run: &Run) -> Result<(), Failure> {
        let metric = |(name, value): (&str, &Option<f64>)| (name.to_owned(), Value::from(*value));
        let metrics: Map<String, Value> = study.metrics.names().zip(&run.values).map(metric).collect();
        let text = serde_json::json!({ "key": key, "metrics": metrics, "accuracy": run.accuracy });
        files::overwrite(&self.file(key), format!("{text}\n").as_bytes())
    }

    /// Path of a run; three letters give 4096 folders, of 2500 runs each in the largest study.
    fn file(&self, key: &str) -> PathBuf {
        self.file_below(key, 3)
    }

    fn file_below(&self, key: &str, letters: usize) -> PathBuf {
        let (first, _) = key.split_at_checked(letters).unwrap_or((key, ""));
        self.folder.join(first).join(format!("{key}.json"))
    }
}
