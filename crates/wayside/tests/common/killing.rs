//! Programs that are killed, and what they leave.

use super::Workplace;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

/// All files below a folder.
pub(crate) fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = vec![];
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        match entry.file_type().unwrap().is_dir() {
            true => found.extend(files(&entry.path())),
            false => found.push(entry.path()),
        }
    }
    found.sort();
    found
}

/// Whether a file is what a writer that is killed leaves behind, until the next run sweeps it.
pub(crate) fn is_temporary(file: &Path) -> bool {
    file.extension().is_some_and(|e| e == "part")
}

/// Whether it was killed before it ended.
pub(crate) fn killed_after(place: &Workplace, words: &str, after: Duration) -> bool {
    is_killed_after(&mut place.command(words), after)
}

/// Whether the command was killed before it ended.
pub(crate) fn is_killed_after(command: &mut Command, after: Duration) -> bool {
    let mut child = command.spawn().unwrap();
    let start = Instant::now();
    while start.elapsed() < after {
        if let Some(status) = child.try_wait().unwrap() {
            assert!(status.success(), "{command:?}: {status}");
            return false;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    !child.wait().unwrap().success()
}

/// Removes results and cache of a run that had ended, so that the next kill has work to interrupt.
pub(crate) fn begin_anew(place: &Workplace) {
    for name in ["out", "cache"] {
        let _ = std::fs::remove_dir_all(place.path(name));
    }
}
