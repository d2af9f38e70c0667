//! Files that belong to a cache, recognized by their names; links never do and are not followed.

use crate::chain::stages::Stage;
use artifact::atomic_file;
use std::fs::Metadata;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// File name of the mark.
pub(super) const MARK: &str = "CACHEDIR.TAG";

/// Whether the place is a symbolic link, which never belongs to the cache.
pub(super) fn is_link(place: &Path) -> bool {
    std::fs::symlink_metadata(place).is_ok_and(|about| about.is_symlink())
}

/// A file that belongs to the cache.
pub struct CacheFile {
    pub path: PathBuf,
    pub bytes: u64,
    pub(super) used: SystemTime,
}

/// Files found in the folder of a cache.
#[derive(Default)]
pub(super) struct FolderListing {
    /// Entries and other files of the cache, without its mark and without temporary files.
    pub(super) files: Vec<CacheFile>,
    /// A file or folder that no cache makes.
    pub(super) foreign: Option<PathBuf>,
}

/// Lists the files in the folders of a cache, and in no others.
pub(super) fn list(root: &Path) -> FolderListing {
    let mut found = FolderListing::default();
    list_folder(Folder::Root, root, &mut found);
    found
}

/// Removes temporary files of ended writers.
pub(super) fn remove_temporary_files(root: &Path) {
    for (_, folder) in folders(root) {
        atomic_file::remove_stale(&folder);
        let old = files_in(&folder)
            .filter(|(file, about)| is_of_earlier_version(file) && is_older_than_an_hour(about));
        old.for_each(|(file, _)| drop(std::fs::remove_file(file)));
    }
}

/// Removes the stages' folders that are empty.
pub(super) fn remove_empty_folders(root: &Path) {
    let own = folders(root).into_iter().filter(|(kind, _)| *kind != Folder::Root);
    // Inner folders first; `remove_dir` leaves those that are not empty.
    own.rev().for_each(|(_, folder)| drop(std::fs::remove_dir(folder)));
}

/// A folder of a cache.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Folder {
    Root,
    Stage,
    /// Entries whose keys begin with these letters.
    Entries([u8; 2]),
    /// Keys of the last run.
    Last,
}

impl Folder {
    /// The kind of a folder of that name in this one.
    fn inner(self, name: &str) -> Option<Self> {
        match (self, name.as_bytes()) {
            (Self::Root, _) => Stage::ALL.iter().any(|stage| stage.name() == name).then_some(Self::Stage),
            (Self::Stage, b"last") => Some(Self::Last),
            (Self::Stage, [a, b]) if is_hexadecimal(&[*a, *b]) => Some(Self::Entries([*a, *b])),
            _ => None,
        }
    }

    /// Whether a cache gives a file in this folder such a name.
    fn holds(self, name: &str) -> bool {
        match self {
            Self::Root => name == "seconds.json", // of earlier versions
            Self::Stage => false,
            Self::Last => name.ends_with(".json") && !name.starts_with('.'),
            Self::Entries(begin) => match name.split_once('.') {
                Some((key, kind)) => is_key(key, begin) && is_kind(kind),
                None => false,
            },
        }
    }
}

fn is_hexadecimal(letters: &[u8]) -> bool {
    letters.iter().all(|c| matches!(c, b'0'..=b'9' | b'a'..=b'f'))
}

fn is_key(name: &str, begin: [u8; 2]) -> bool {
    name.len() == 64 && name.as_bytes().starts_with(&begin) && is_hexadecimal(name.as_bytes())
}

fn is_kind(name: &str) -> bool {
    (2..=24).contains(&name.len())
        && name.bytes().all(|c| matches!(c, b'a'..=b'z' | b'0'..=b'9' | b'-' | b'_'))
}

/// Whether the file has the name of an earlier version's temporary file: `.<name>.<six letters>.part`.
fn is_of_earlier_version(file: &Path) -> bool {
    let name = file.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    name.starts_with('.') && name.ends_with(".part") && !atomic_file::is_temporary(file)
}

fn is_older_than_an_hour(about: &Metadata) -> bool {
    about.modified().ok().and_then(|written| written.elapsed().ok()).is_some_and(|age| age.as_secs() > 3600)
}

fn list_folder(kind: Folder, folder: &Path, found: &mut FolderListing) {
    for (path, about) in entries(folder) {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let inner = kind.inner(name).filter(|_| about.is_dir());
        match inner {
            Some(inner) => list_folder(inner, &path, found),
            None if about.is_file() && kind.holds(name) => {
                let used = about.modified().unwrap_or(SystemTime::UNIX_EPOCH);
                found.files.push(CacheFile { path, bytes: about.len(), used });
            }
            None if about.is_file() && is_beside(kind, name, &path) => {}
            None => found.foreign = Some(path),
        }
    }
}

/// Whether a file is the mark or a temporary file.
fn is_beside(kind: Folder, name: &str, path: &Path) -> bool {
    (kind == Folder::Root && name == MARK) || atomic_file::is_temporary(path) || is_of_earlier_version(path)
}

/// The cache's own folders, outer ones first.
fn folders(root: &Path) -> Vec<(Folder, PathBuf)> {
    let mut folders = vec![(Folder::Root, root.to_owned())];
    let mut next = 0;
    while let Some((kind, folder)) = folders.get(next).cloned() {
        let inner = entries(&folder).filter(|(_, about)| about.is_dir()).filter_map(|(path, _)| {
            let inner = kind.inner(path.file_name()?.to_str()?)?;
            Some((inner, path))
        });
        folders.extend(inner.collect::<Vec<_>>());
        next += 1;
    }
    folders
}

fn files_in(folder: &Path) -> impl Iterator<Item = (PathBuf, Metadata)> {
    entries(folder).filter(|(_, about)| about.is_file())
}

/// Entries of a folder with their metadata; links are not followed.
fn entries(folder: &Path) -> impl Iterator<Item = (PathBuf, Metadata)> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.filter_map(|entry| Some((entry.path(), entry.metadata().ok()?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cache_knows_its_own_names_and_no_others() {
        let key = "ab".to_owned() + &"0".repeat(62);
        let entries = Folder::Root.inner("dsp").and_then(|stage| stage.inner("ab")).unwrap();
        assert!(entries.holds(&format!("{key}.rdm")) && entries.holds(&format!("{key}.json")));
        let foreign = [
            "mod.rs".to_owned(),
            key.clone(),
            format!("{key}."),
            format!("{key}.tar.gz"),
            format!("{key}.RDM"),
            format!("{}.rdm", key.replace('b', "c")),
            format!("{}.rdm", &key[1..]),
        ];
        foreign.iter().for_each(|name| assert!(!entries.holds(name), "{name}"));
        let last = Folder::Root.inner("dsp").and_then(|stage| stage.inner("last")).unwrap();
        assert!(last.holds("small-0000.json") && !last.holds("notes.txt") && !last.holds(".json"));
        for (folder, inner) in
            [(Folder::Root, "src"), (Folder::Stage, "src"), (Folder::Stage, "AB"), (last, "ab")]
        {
            assert!(folder.inner(inner).is_none(), "{folder:?} {inner}");
        }
        assert!(!Folder::Root.holds("Cargo.toml") && !Folder::Stage.holds("Cargo.toml"));
    }
}
