//! Keys of kept frames hold the sources of all that a stage is built with.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../dependencies.rs"]
mod dependencies;

use std::path::Path;

#[test]
fn what_reads_recordings_of_other_programs_is_among_the_sources_of_scenes() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let names = |stage: &str| {
        let folders = dependencies::of(&root, stage).unwrap();
        folders.iter().map(|f| f.file_name().unwrap().to_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(names("scene"), ["artifact", "bodies", "radar", "interchange"]);
    assert_eq!(names("bart-rcs"), ["artifact", "radar"], "no test's alone");
    assert!(dependencies::of(&root, "nothing").is_err());
}
