//! Cache of whole stage frames, keyed by all their inputs.
//!
//! Each entry, `<stage>/<first two letters>/<key>.<kind>`, is one artifact of one frame and is written whole
//! or not at all, so concurrent runs are safe: at worst both compute the same bytes. A hit renews an entry's
//! time; beyond the size limit the oldest entries are removed first. `<stage>/last/<scene>-<frame>.json`
//! holds the parts of the last key, so that a plan can say which of them changed.
//!
//! A folder is used as a cache only if it is marked as one (`marker`), and only files with the names of a
//! cache's files are removed from it (`cache_files`): whatever folder `--cache` names, nothing else in it is
//! touched.

mod marker;
mod cache_files;
mod checksummed_json;

use crate::chain::keys::Key;
use crate::chain::stages::Stage;
use crate::host::checkpoint::SavedWork;
use crate::host::default_paths;
use crate::host::failure::Failure;
use crate::host::progress;
use artifact::{ArtifactError, Fault, Provenance, Reader, Schema, Writer};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::SystemTime;

pub(crate) use cache_files::CacheFile;

/// Folder of a cache and the size to which it may grow.
#[derive(Debug, Clone)]
pub struct CacheLocation {
    /// Folder of the cache. `None`: `.cache` of the project's folder, or outside the project the user's cache
    /// folder, if there is one (`host::default_paths`).
    pub folder: Option<PathBuf>,
    /// Total size of the entries above which the oldest are removed, MiB.
    pub limit_mib: u64,
}

impl Default for CacheLocation {
    fn default() -> Self {
        Self { folder: None, limit_mib: 8192 }
    }
}

/// Reason why there is no default cache, with its remedy.
pub const NO_DEFAULT: &str = "neither XDG_CACHE_HOME nor HOME names a folder; --cache DIR takes one";

/// An open cache.
pub struct Cache {
    root: PathBuf,
    limit_bytes: u64,
    /// Whether the folder could be marked; set when the first entry is kept.
    marked: OnceLock<bool>,
}

impl Cache {
    /// Opens the folder, which is created with the first entry if it is missing. Refuses a folder that is no
    /// cache. `None` if no folder is given and there is no default.
    pub fn open(location: &CacheLocation) -> Result<Option<Self>, Failure> {
        let Some(root) = location.folder.clone().or_else(default_paths::default_cache) else {
            return Ok(None);
        };
        marker::check(&root)?;
        Ok(Some(Self { root, limit_bytes: location.limit_mib << 20, marked: OnceLock::new() }))
    }

    /// Opens the cache of a run; notes if there is none.
    ///
    /// # Errors
    /// The folder is no cache.
    pub fn of_run(location: Option<&CacheLocation>) -> Result<Option<Self>, Failure> {
        let Some(location) = location else { return Ok(None) };
        let cache = Self::open(location)?;
        if cache.is_none() {
            progress::note(format!("note: nothing is cached: {NO_DEFAULT}"));
        }
        Ok(cache)
    }

    /// Refuses a cache folder that holds, or is, an output folder: results are permanent, while a cache
    /// removes files with the names of its own. A cache below an output folder is allowed.
    pub fn apart_from<'a>(&self, outs: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
        let root = default_paths::resolved(&self.root);
        match outs.into_iter().find(|out| default_paths::resolved(out).starts_with(&root)) {
            Some(out) => Err(Failure::System(format!(
                "{}: --out and --cache have to be two folders, and no result lies within a cache ({})",
                out.display(),
                self.root.display()
            ))),
            None => Ok(()),
        }
    }

    /// Folder of the cache.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Path of the entry of this key, whether it exists or not.
    pub(crate) fn place(&self, stage: Stage, key: &Key, kind: &str) -> PathBuf {
        let id = key.id();
        self.root.join(stage.name()).join(&id[..2]).join(format!("{id}.{kind}"))
    }

    /// Whether the entry exists.
    pub(crate) fn holds(&self, stage: Stage, key: &Key, kind: &str) -> bool {
        self.place(stage, key, kind).is_file()
    }

    /// Reads the frame of an entry; a damaged entry is named, removed and treated as missing.
    pub(crate) fn get<S: Schema>(&self, stage: Stage, key: &Key) -> Option<S::Frame> {
        self.entry::<S>(stage, key, Content::OneFrame)?.1
    }

    /// Header of an entry without frames; a damaged entry is treated as in [`Cache::get`].
    pub(crate) fn get_header<S: Schema>(&self, stage: Stage, key: &Key) -> Option<S::Header> {
        Some(self.entry::<S>(stage, key, Content::Header)?.0)
    }

    /// Keeps one frame. A write failure is reported once and costs only time.
    pub(crate) fn put<S: Schema>(&self, stage: Stage, key: &Key, header: &S::Header, frame: &S::Frame) {
        self.keep::<S>(stage, key, header, &[frame]);
    }

    /// Keeps a header without frames; a cache that cannot be written is treated as in [`Cache::put`].
    pub(crate) fn put_header<S: Schema>(&self, stage: Stage, key: &Key, header: &S::Header) {
        self.keep::<S>(stage, key, header, &[]);
    }

    /// Key that this frame of this scene had when it was last computed; a damaged file is named and ignored.
    pub(crate) fn last_key(&self, stage: Stage, scene: &str, frame: u32) -> Option<Key> {
        checksummed_json::read(&self.last_place(stage, scene, frame))
    }

    /// Remembers the key that this frame of this scene has now.
    pub(crate) fn remember_key(&self, stage: Stage, scene: &str, frame: u32, key: &Key) {
        if self.is_marked() {
            checksummed_json::write(&self.last_place(stage, scene, frame), key); // only explanations need it
        }
    }

    fn last_place(&self, stage: Stage, scene: &str, frame: u32) -> PathBuf {
        let scene: String =
            scene.chars().map(|c| if c.is_alphanumeric() || c == '-' { c } else { '_' }).collect();
        self.root.join(stage.name()).join("last").join(format!("{scene}-{frame:04}.json"))
    }

    /// All files that belong to the cache, oldest first.
    pub fn files(&self) -> Vec<CacheFile> {
        let mut files = cache_files::list(&self.root).files;
        files.sort_by(|a, b| (a.used, &a.path).cmp(&(b.used, &b.path)));
        files
    }

    /// Removes the oldest files until the rest is within the limit, and temporary files of ended writers.
    pub fn trim(&self) {
        cache_files::remove_temporary_files(&self.root);
        let files = self.files();
        let mut bytes: u64 = files.iter().map(|file| file.bytes).sum();
        for file in &files {
            if bytes <= self.limit_bytes {
                break;
            }
            if std::fs::remove_file(&file.path).is_ok() {
                bytes -= file.bytes;
            }
        }
    }

    /// Empties the cache; its mark and foreign files stay.
    pub fn clear(&self) -> Result<(), Failure> {
        cache_files::remove_temporary_files(&self.root);
        for file in self.files() {
            match std::fs::remove_file(&file.path) {
                Err(e) if e.kind() != std::io::ErrorKind::NotFound => {
                    return Err(Failure::system(&file.path, "remove", e));
                }
                _ => {}
            }
        }
        cache_files::remove_empty_folders(&self.root);
        Ok(())
    }

    fn entry<S: Schema>(
        &self,
        stage: Stage,
        key: &Key,
        content: Content,
    ) -> Option<(S::Header, Option<S::Frame>)> {
        let place = self.place(stage, key, S::NAME);
        if !place.is_file() {
            return None;
        }
        match read_entry::<S>(&place, key, content) {
            Ok(entry) => {
                touch(&place);
                Some(entry)
            }
            Err(why) => {
                discard(&place, &why);
                None
            }
        }
    }

    fn keep<S: Schema>(&self, stage: Stage, key: &Key, header: &S::Header, frames: &[&S::Frame]) {
        let place = self.place(stage, key, S::NAME);
        if !self.is_marked() || cache_files::is_link(&place) {
            return;
        }
        let provenance =
            Provenance { stage: stage.name().into(), inputs: key.parts.clone(), ..Provenance::default() };
        let written = Writer::<S>::create(&place, &provenance, header).and_then(|mut writer| {
            frames.iter().try_for_each(|frame| writer.write(frame))?;
            writer.finish()
        });
        if let Err(error) = written {
            failed(SavedWork::UntilFailure, &error);
        }
    }

    /// Creates and marks the folder before the first file is put into it.
    fn is_marked(&self) -> bool {
        *self.marked.get_or_init(|| {
            marker::set(&self.root).map_err(|error| failed(SavedWork::Nothing, &error)).is_ok()
        })
    }
}

/// Content of an entry: a header alone, or a header and one frame.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Content {
    Header,
    OneFrame,
}

/// Fault of an invalid entry.
#[derive(Debug, thiserror::Error)]
enum EntryFault {
    #[error("{0}")]
    Artifact(#[from] ArtifactError),
    #[error("{}: is the entry of another key: it was put under this name", .0.display())]
    OtherKey(PathBuf),
    #[error("{}: does not hold what an entry of its kind holds", .0.display())]
    OtherContent(PathBuf),
}

/// Reads an entry to its end.
fn read_entry<S: Schema>(
    place: &Path,
    key: &Key,
    content: Content,
) -> Result<(S::Header, Option<S::Frame>), EntryFault> {
    let mut reader = Reader::<S>::open_own(place)?;
    if reader.preamble().provenance.inputs != key.parts {
        return Err(EntryFault::OtherKey(place.to_owned()));
    }
    let frame = reader.next_frame()?;
    let is_as_told = frame.is_some() == (content == Content::OneFrame);
    if !is_as_told || (frame.is_some() && reader.next_frame()?.is_some()) {
        return Err(EntryFault::OtherContent(place.to_owned()));
    }
    Ok((reader.into_header(), frame))
}

fn touch(place: &Path) {
    if let Ok(file) = std::fs::File::options().append(true).open(place) {
        let _ = file.set_modified(SystemTime::now()); // only the order of eviction hangs on it
    }
}

/// Removes a damaged entry and reports it; an unreadable entry or a link stays: the first may be readable
/// later, and a link does not belong to the cache.
fn discard(place: &Path, why: &EntryFault) {
    let is_unread = matches!(why, EntryFault::Artifact(ArtifactError { fault: Fault::System { .. }, .. }));
    if is_unread || cache_files::is_link(place) {
        progress::note(format!("note: cache entry not used: {why}"));
    } else {
        progress::note(format!("note: damaged cache entry removed, it is made anew: {why}"));
        let _ = std::fs::remove_file(place);
    }
}

/// Part of the finished work that is in the cache since its first failure.
static SINCE_FAILURE: OnceLock<SavedWork> = OnceLock::new();

/// Part of the finished work that the next run finds in this process's cache.
pub fn saved_work() -> SavedWork {
    SINCE_FAILURE.get().copied().unwrap_or(SavedWork::All)
}

/// Reports the first failure only: a full disk or a protected folder fails for every entry.
fn failed(kept: SavedWork, error: &dyn std::fmt::Display) {
    SINCE_FAILURE.get_or_init(|| {
        progress::note(format!("note: not cached: {error}"));
        kept
    });
}
