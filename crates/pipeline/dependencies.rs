//! Crates of the project that a crate is built with, by its `Cargo.toml`: what `build.rs` hashes with the
//! sources of a stage.

use std::path::{Path, PathBuf};

/// Folders of the project's crates that `name` depends on, tests aside, in the order of its `Cargo.toml`;
/// those too that a feature brings.
pub(crate) fn of(root: &Path, name: &str) -> std::io::Result<Vec<PathBuf>> {
    let crates = root.join("crates");
    let text = std::fs::read_to_string(crates.join(name).join("Cargo.toml"))?;
    let section = text.split("\n[").find_map(|section| section.strip_prefix("dependencies]\n"));
    let names = section.unwrap_or_default().lines().filter_map(|line| line.split(['.', ' ', '=']).next());
    let folders = names.filter(|name| !name.is_empty()).map(|name| crates.join(name));
    Ok(folders.filter(|folder| folder.join("Cargo.toml").is_file()).collect())
}
