//! A program that is told to stop leaves nothing of what it was writing; alone in its process, because all
//! that is open there goes.
#![allow(clippy::unwrap_used, reason = "a test ends where it meets what it did not expect")]

use artifact::whole_file::{WholeFile, WholeFolder, abandon_all};

#[test]
fn a_program_that_is_told_to_stop_leaves_no_file_and_no_folder() {
    let folder = tempfile::tempdir().unwrap();
    let _file = WholeFile::create(&folder.path().join("a")).unwrap();
    let set = WholeFolder::create(&folder.path().join("set")).unwrap();
    std::fs::create_dir(set.filled().join("below")).unwrap();
    std::fs::write(set.filled().join("below/file"), "x").unwrap();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    drop(abandon_all());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
