//! Check for cyclic dependencies between files of any crate, and for folders with too many files.

use crate::ci::findings::fail_on;
use crate::house::{self, dependencies::FileDependencies, folders};
use crate::project::project_root;
use std::path::Path;
use wayside::host::failure::Failure;

/// Largest number of files in one folder.
const MAX_FILES_PER_FOLDER: usize = 15;

pub(super) fn check() -> Result<(), Failure> {
    let mut broken = Vec::new();
    for folder in house::crates(&project_root())? {
        let (dependencies, cycles) = house::dependencies_and_cycles(&folder)?;
        broken.extend(cycles.iter().map(|cycle| sentence(&dependencies, cycle)));
        broken.extend(crowded_folders(&folder));
    }
    fail_on(broken)
}

fn sentence(dependencies: &FileDependencies, cycle: &[usize]) -> String {
    let name = |file: &usize| dependencies.files[*file].place.display().to_string();
    format!("these files use each other: {}", cycle.iter().map(name).collect::<Vec<_>>().join(", "))
}

fn crowded_folders(folder: &Path) -> Vec<String> {
    let many =
        folders::files_per_folder(folder).into_iter().filter(|(_, files)| *files > MAX_FILES_PER_FOLDER);
    many.map(|(place, files)| {
        format!("{}: {files} files side by side, the limit is {MAX_FILES_PER_FOLDER}", place.display())
    })
    .collect()
}
