//! A program that is told to stop while its threads write leaves nothing, whatever they do until it has
//! ended; alone in its process, because all that is open there goes.
#![allow(clippy::unwrap_used, reason = "a test ends where it meets what it did not expect")]

use artifact::atomic_file::{AtomicFile, AtomicFolder, Durability, is_temporary, remove_all_temporaries};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Temporary files and folders in a folder, and below.
fn temporaries(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    entries.map(|place| usize::from(is_temporary(&place)) + temporaries(&place)).sum()
}

/// Begins files and folders, and finishes every other one, until it is told to end.
fn write(folder: &Path, thread: usize, ends: &AtomicBool) {
    for number in (0..).take_while(|_| !ends.load(Ordering::Relaxed)) {
        let place = folder.join(format!("{thread}/{number}"));
        let file = AtomicFile::create(&place.join("file"));
        if let Some(file) = file.ok().filter(|_| number % 2 == 0) {
            let _ = file.finish(Durability::InCache); // it may be gone
        }
        let set = AtomicFolder::create(&place.join("set"));
        if let Ok(set) = set.inspect(|set| drop(AtomicFile::create(&set.path().join("below/file"))))
            && number % 2 == 0
        {
            let _ = set.finish();
        }
    }
}

#[test]
fn what_threads_begin_while_a_program_ends_is_not_left_behind() {
    let (folder, ends) = (tempfile::tempdir().unwrap(), AtomicBool::new(false));
    std::thread::scope(|scope| {
        for thread in 0..4 {
            let (folder, ends) = (folder.path(), &ends);
            scope.spawn(move || write(folder, thread, ends));
        }
        for round in 0..20 {
            std::thread::sleep(Duration::from_millis(3));
            let held = remove_all_temporaries();
            let left: Vec<usize> = (0..3)
                .map(|_| {
                    std::thread::sleep(Duration::from_millis(1));
                    temporaries(folder.path())
                })
                .collect();
            drop(held);
            if left.iter().any(|left| *left > 0) {
                ends.store(true, Ordering::Relaxed);
            }
            assert_eq!(left, [0; 3], "round {round}");
        }
        ends.store(true, Ordering::Relaxed);
    });
}
