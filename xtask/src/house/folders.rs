//! Files that stand side by side.

use std::path::{Path, PathBuf};

/// The most source files in one folder of a crate.
pub(crate) fn largest(folder: &Path) -> usize {
    each(folder).into_iter().map(|(_, files)| files).max().unwrap_or(0)
}

/// Folders of a crate with their number of source files.
pub(crate) fn each(folder: &Path) -> Vec<(String, usize)> {
    let mut all = Vec::new();
    count(folder, &mut all);
    all
}

fn count(folder: &Path, all: &mut Vec<(String, usize)>) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|place| place.is_dir());
    let sources = files.iter().filter(|file| file.extension().is_some_and(|kind| kind == "rs")).count();
    all.push((folder.display().to_string(), sources));
    folders.iter().filter(|folder| !folder.ends_with("target")).for_each(|folder| count(folder, all));
}

/// Rust files of a folder and of those in it.
pub(crate) fn sources(folder: &Path, files: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path());
    for entry in entries {
        match entry.extension() {
            _ if entry.is_dir() && !entry.ends_with("target") => sources(&entry, files),
            Some(e) if e == "rs" => files.push(entry),
            _ => {}
        }
    }
}

/// All files of a folder and of those in it, in the order of their paths.
pub(crate) fn files_below(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path());
    let each = |place: PathBuf| if place.is_dir() { files_below(&place) } else { vec![place] };
    let mut files: Vec<PathBuf> = entries.flat_map(each).collect();
    files.sort();
    files
}
