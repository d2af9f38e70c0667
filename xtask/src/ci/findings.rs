//! Common parts of the checks of the source: its files, and a failure that holds every finding.

use crate::house::folders::{self, files_below};
use crate::project::project_root;
use std::path::{Path, PathBuf};
use wayside::host::failure::Failure;

/// Line width of code, comments and prose, as in `rustfmt.toml`.
pub(super) const COLUMNS: usize = 110;

/// A failure with a line for each finding, if there are any.
pub(super) fn fail_on(findings: Vec<String>) -> Result<(), Failure> {
    if findings.is_empty() { Ok(()) } else { Err(Failure::Refused(findings.join("\n"))) }
}

/// The text of a file.
pub(super) fn read(file: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(file).map_err(|e| Failure::system(file, "read", e))
}

/// Every source file of the workspace.
pub(super) fn sources() -> Vec<PathBuf> {
    ["crates", "xtask"].iter().flat_map(|place| folders::sources(&project_root().join(place))).collect()
}

/// The pages of the project.
pub(super) fn pages(root: &Path) -> Vec<PathBuf> {
    let own = ["README.md", "CONTRIBUTING.md"].map(|name| root.join(name));
    let docs = files_below(&root.join("docs"))
        .into_iter()
        .filter(|file| file.extension().is_some_and(|e| e == "md"));
    own.into_iter().chain(docs).collect()
}
