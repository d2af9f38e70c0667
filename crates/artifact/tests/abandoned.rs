//! A program that is told to stop leaves nothing of what it was writing; alone in its process, because all
//! that is open there goes.
#![allow(clippy::unwrap_used, reason = "a test ends where it meets what it did not expect")]

use artifact::atomic_file::{AtomicFile, AtomicFolder, remove_all_temporaries};

#[test]
fn a_program_that_is_told_to_stop_leaves_no_file_and_no_folder() {
    let folder = tempfile::tempdir().unwrap();
    let _file = AtomicFile::create(&folder.path().join("a")).unwrap();
    let set = AtomicFolder::create(&folder.path().join("set")).unwrap();
    std::fs::create_dir(set.path().join("below")).unwrap();
    std::fs::write(set.path().join("below/file"), "x").unwrap();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    drop(remove_all_temporaries());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
