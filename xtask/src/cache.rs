//! Whole frames of stages, found by what they depend on.
//!
//! One artifact of one frame per entry, `<stage>/<first two letters>/<key>.<kind>`, written whole or not at all, so that
//! two runs at once do not hurt each other: at worst both compute the same bytes. A hit renews an entry's time; beyond
//! the size limit the oldest go first. `<stage>/last/<scene>-<frame>.json` remembers the key's parts, so that a plan can
//! say which of them changed.

use crate::cli::CacheLocation;
use crate::failure::Failure;
use crate::keys::Key;
use crate::output;
use crate::progress;
use crate::stages::Stage;
use artifact::{Provenance, Reader, Schema, Writer};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// An open cache.
pub(crate) struct Cache {
    root: PathBuf,
    limit_bytes: u64,
}

impl Cache {
    /// Opens the folder; it is made with the first entry.
    pub(crate) fn open(location: &CacheLocation) -> Self {
        let root = location.cache.clone().unwrap_or_else(|| project_root().join(".cache"));
        Self { root, limit_bytes: location.cache_limit_mib << 20 }
    }

    /// Where it lies.
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// Where the entry of this key lies, whether it exists or not.
    pub(crate) fn place(&self, stage: Stage, key: &Key, kind: &str) -> PathBuf {
        let id = key.id();
        self.root.join(stage.name()).join(&id[..2]).join(format!("{id}.{kind}"))
    }

    /// Whether the entry exists.
    pub(crate) fn holds(&self, stage: Stage, key: &Key, kind: &str) -> bool {
        self.place(stage, key, kind).is_file()
    }

    /// The entry's header and first frame; a damaged entry is removed and counts as missing.
    pub(crate) fn get<S: Schema>(&self, stage: Stage, key: &Key) -> Option<S::Frame> {
        let place = self.place(stage, key, S::NAME);
        let read = |place: &Path| Reader::<S>::open(place)?.next_frame();
        match read(&place) {
            Ok(frame) => {
                renew(&place);
                frame
            }
            Err(error) => {
                discard(&place, &error);
                None
            }
        }
    }

    /// Keeps one frame. A cache that cannot be written is said once and costs only time.
    pub(crate) fn put<S: Schema>(&self, stage: Stage, key: &Key, header: &S::Header, frame: &S::Frame) {
        let place = self.place(stage, key, S::NAME);
        let provenance = Provenance { stage: stage.name().into(), inputs: key.parts.clone(), ..Provenance::default() };
        let written = Writer::<S>::create(&place, &provenance, header).and_then(|mut writer| {
            writer.write(frame)?;
            writer.finish()
        });
        if let Err(error) = written {
            progress::note(format!("note: not cached: {error}"));
        }
    }

    /// As [`Cache::get`] for content that is JSON, not an artifact.
    pub(crate) fn get_json<T: serde::de::DeserializeOwned>(&self, stage: Stage, key: &Key) -> Option<T> {
        let place = self.place(stage, key, "json");
        let text = std::fs::read(&place).ok()?;
        renew(&place);
        serde_json::from_slice(&text).map_err(|e| discard(&place, &e)).ok()
    }

    /// As [`Cache::put`] for content that is JSON, not an artifact.
    pub(crate) fn put_json<T: serde::Serialize>(&self, stage: Stage, key: &Key, value: &T) {
        let place = self.place(stage, key, "json");
        let bytes = serde_json::to_vec(value).unwrap_or_default();
        if let Err(failure) = output::write_file(&place, &bytes) {
            progress::note(format!("note: not cached: {failure}"));
        }
    }

    /// The key that this frame of this scene had when it was last computed.
    pub(crate) fn last_key(&self, stage: Stage, scene: &str, frame: u32) -> Option<Key> {
        let text = std::fs::read(self.last_place(stage, scene, frame)).ok()?;
        serde_json::from_slice(&text).ok()
    }

    /// Remembers the key that this frame of this scene has now.
    pub(crate) fn remember_key(&self, stage: Stage, scene: &str, frame: u32, key: &Key) {
        let bytes = serde_json::to_vec(key).unwrap_or_default();
        let _ = output::write_file(&self.last_place(stage, scene, frame), &bytes); // only explanations need it
    }

    fn last_place(&self, stage: Stage, scene: &str, frame: u32) -> PathBuf {
        let scene: String = scene.chars().map(|c| if c.is_alphanumeric() || c == '-' { c } else { '_' }).collect();
        self.root.join(stage.name()).join("last").join(format!("{scene}-{frame:04}.json"))
    }

    /// All entries with size and time, oldest first.
    pub(crate) fn entries(&self) -> Vec<Entry> {
        let mut entries = Vec::new();
        collect(&self.root, &mut entries);
        entries.sort_by(|a, b| (a.used, &a.file).cmp(&(b.used, &b.file)));
        entries
    }

    /// Removes the oldest entries until the rest is within the limit, and what dead writers left behind.
    pub(crate) fn trim(&self) {
        let entries = self.entries();
        let mut size: u64 = entries.iter().map(|e| e.bytes).sum();
        for entry in &entries {
            let abandoned = entry.is_partial() && entry.is_older_than_an_hour();
            if size > self.limit_bytes || abandoned {
                let _ = std::fs::remove_file(&entry.file);
                size -= entry.bytes;
            }
        }
    }

    /// Empties it; what is not the cache's own stays.
    pub(crate) fn clear(&self) -> Result<(), Failure> {
        for folder in Stage::ALL.map(|s| self.root.join(s.name())) {
            match std::fs::remove_dir_all(&folder) {
                Err(e) if e.kind() != std::io::ErrorKind::NotFound => {
                    return Err(Failure::system(&folder, "remove", e));
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// A file in the cache.
pub(crate) struct Entry {
    pub(crate) file: PathBuf,
    pub(crate) bytes: u64,
    used: SystemTime,
}

impl Entry {
    fn is_partial(&self) -> bool {
        self.file.extension().is_some_and(|e| e == "part")
    }

    fn is_older_than_an_hour(&self) -> bool {
        self.used.elapsed().is_ok_and(|age| age.as_secs() > 3600)
    }
}

/// The root of the project: where `Cargo.toml` of the workspace lies, as long as it is still there, else this folder.
pub(crate) fn project_root() -> PathBuf {
    let built_in = Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(Path::to_owned);
    built_in.filter(|p| p.join("Cargo.toml").is_file()).unwrap_or_else(|| PathBuf::from("."))
}

fn collect(folder: &Path, entries: &mut Vec<Entry>) {
    let Ok(list) = std::fs::read_dir(folder) else { return };
    for item in list.flatten() {
        match item.metadata() {
            Ok(about) if about.is_dir() => collect(&item.path(), entries),
            Ok(about) => {
                let used = about.modified().unwrap_or(SystemTime::UNIX_EPOCH);
                entries.push(Entry { file: item.path(), bytes: about.len(), used });
            }
            Err(_) => {}
        }
    }
}

fn renew(place: &Path) {
    if let Ok(file) = std::fs::File::options().append(true).open(place) {
        let _ = file.set_modified(SystemTime::now()); // only the order of eviction hangs on it
    }
}

fn discard(place: &Path, why: &dyn std::fmt::Display) {
    if place.is_file() {
        progress::note(format!("note: damaged cache entry removed: {why}"));
        let _ = std::fs::remove_file(place);
    }
}
