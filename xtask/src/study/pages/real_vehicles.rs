//! Real vehicles, of third parties, in `../shared/vehicles`.

use crate::project::shared;
use artifact::scene::Mesh;
use std::path::{Path, PathBuf};
use wayside::host::failure::Failure;

/// Folder of the files.
pub(super) fn folder() -> PathBuf {
    shared().join("vehicles")
}

/// Files of all vehicles in the order of their names; `None` if the folder is missing.
pub(super) fn files() -> Option<Vec<PathBuf>> {
    let entries = std::fs::read_dir(folder()).ok()?;
    let mut files: Vec<PathBuf> = entries.flatten().map(|file| file.path()).collect();
    files.retain(|file| file.extension().is_some_and(|kind| kind == "glb"));
    files.sort();
    Some(files)
}

/// Name of a vehicle by its file.
pub(super) fn name_of(file: &Path) -> String {
    file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// Mesh of a vehicle.
pub(super) fn mesh(file: &Path) -> Result<Mesh, Failure> {
    scene::read_mesh(file, &scene::MeshOptions { unit_scale: None }).map_err(Failure::refused)
}
