//! Check for cyclic dependencies between files of any crate, and for folders with too many files.

use crate::ci::findings::none_of;
use crate::house::{self, arrows::Arrows, folders};
use crate::project::project_root;
use std::path::Path;
use wayside::host::failure::Failure;

/// Largest number of files in one folder.
const SIDE_BY_SIDE: usize = 15;

pub(super) fn check() -> Result<(), Failure> {
    let mut broken = Vec::new();
    for folder in house::crates(&project_root())? {
        let (arrows, circles) = house::look(&folder)?;
        broken.extend(circles.iter().map(|circle| sentence(&arrows, circle)));
        broken.extend(crowded(&folder));
    }
    none_of(broken)
}

fn sentence(arrows: &Arrows, circle: &[usize]) -> String {
    let name = |file: &usize| arrows.files[*file].place.display().to_string();
    format!("these files use each other: {}", circle.iter().map(name).collect::<Vec<_>>().join(", "))
}

fn crowded(folder: &Path) -> Vec<String> {
    let many = folders::side_by_side(folder).into_iter().filter(|(_, files)| *files > SIDE_BY_SIDE);
    many.map(|(place, files)| {
        format!("{}: {files} files side by side, the limit is {SIDE_BY_SIDE}", place.display())
    })
    .collect()
}
