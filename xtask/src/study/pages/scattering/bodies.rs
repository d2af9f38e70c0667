//! Vehicles of studies: the project's own, and real ones if present.

use crate::project::{project_root, shared};
use artifact::scene::{Mesh, SceneHeader};
use std::path::{Path, PathBuf};
use wayside::host::failure::Failure;
use wayside::host::progress::note;

/// A vehicle by its name.
pub(super) type Named = (String, Mesh);

/// One of the project's own.
pub(super) fn own(name: &str) -> Result<Mesh, Failure> {
    scene::vehicles::mesh(name, 1).ok_or_else(|| Failure::Refused(format!("there is no vehicle {name}")))
}

/// All vehicles of the project's own.
pub(super) fn all_own() -> Result<Vec<Named>, Failure> {
    scene::vehicles::NAMES.iter().map(|name| Ok(((*name).to_owned(), own(name)?))).collect()
}

/// Own vehicles, then the real ones in the order of their names; a remark if these are missing.
pub(super) fn all() -> Result<Vec<Named>, Failure> {
    let mut meshes = all_own()?;
    let folder = shared().join("vehicles");
    let Ok(files) = std::fs::read_dir(&folder) else {
        note(format!("{} is not here: own vehicles take the places of real ones", folder.display()));
        return Ok(meshes);
    };
    let mut files: Vec<PathBuf> = files.flatten().map(|file| file.path()).collect();
    files.retain(|file| file.extension().is_some_and(|kind| kind == "glb"));
    files.sort();
    for file in files {
        meshes.push((file.file_stem().unwrap_or_default().to_string_lossy().into_owned(), read(&file)?));
    }
    Ok(meshes)
}

/// One of the real ones, by name.
pub(super) fn real(name: &str) -> Result<Mesh, Failure> {
    read(&shared().join("vehicles").join(format!("{name}.glb")))
}

fn read(file: &Path) -> Result<Mesh, Failure> {
    scene::read_mesh(file, &scene::MeshOptions { unit_scale: None }).map_err(Failure::refused)
}

/// The header to which random frames add one vehicle.
pub(super) fn experiment_1() -> Result<SceneHeader, Failure> {
    let options = scene::ReadOptions::names_only();
    scene::read(&project_root().join("scenes/experiment-1.toml"), &options).map_err(Failure::refused)
}
