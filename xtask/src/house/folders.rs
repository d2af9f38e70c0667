//! Files of folders: all of them, source files, and their number per folder.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// All files in and below a folder, in the order of their paths, without cargo's build output.
pub(crate) fn files_below(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path());
    let each = |place: PathBuf| match place.is_dir() {
        true if place.ends_with("target") => vec![],
        true => files_below(&place),
        false => vec![place],
    };
    let mut files: Vec<PathBuf> = entries.flat_map(each).collect();
    files.sort();
    files
}

/// Rust files in and below a folder, in the order of their paths.
pub(crate) fn sources(folder: &Path) -> Vec<PathBuf> {
    files_below(folder).into_iter().filter(|file| file.extension().is_some_and(|kind| kind == "rs")).collect()
}

/// Folders of a crate with source files, with their numbers.
pub(crate) fn files_per_folder(folder: &Path) -> BTreeMap<PathBuf, usize> {
    let mut all = BTreeMap::new();
    for file in sources(folder) {
        *all.entry(file.parent().unwrap_or(folder).to_owned()).or_default() += 1;
    }
    all
}
