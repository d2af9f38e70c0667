//! Files that are written whole or not at all. A program of its own, as [`remove_all_temporaries`] removes
//! what any test is writing.

#![allow(clippy::unwrap_used, reason = "a test ends where it meets what it did not expect")]

use artifact::atomic_file::{AtomicFile, Durability, remove_all_temporaries};
use std::io::Write;

#[test]
fn an_abandoned_file_leaves_its_place_as_it_was_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("deep/table.csv");
    let write = |text: &str| {
        let mut file = AtomicFile::create(&place).unwrap();
        file.write_all(text.as_bytes()).unwrap();
        file
    };
    write("old").finish(Durability::InCache).unwrap();
    drop(write("new"));
    let interrupted = write("newer");
    drop(remove_all_temporaries());
    let left = std::fs::read_dir(place.parent().unwrap()).unwrap().count();
    assert_eq!((std::fs::read_to_string(&place).unwrap().as_str(), left), ("old", 1));
    assert!(interrupted.finish(Durability::OnDisk).is_err_and(|e| e.is_system()));
}
