//! Vehicles of studies: the project's own, and real ones if present.

use crate::project::project_root;
use crate::study::pages::real_vehicles;
use artifact::scene::{Mesh, SceneHeader};
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
    let Some(files) = real_vehicles::files() else {
        let folder = real_vehicles::folder();
        note(format!("{} is not here: own vehicles take the places of real ones", folder.display()));
        return Ok(meshes);
    };
    for file in files {
        meshes.push((real_vehicles::name_of(&file), real_vehicles::mesh(&file)?));
    }
    Ok(meshes)
}

/// One of the real ones, by name.
pub(super) fn real(name: &str) -> Result<Mesh, Failure> {
    real_vehicles::mesh(&real_vehicles::folder().join(format!("{name}.glb")))
}

/// The header to which random frames add one vehicle.
pub(super) fn experiment_1() -> Result<SceneHeader, Failure> {
    let options = scene::ReadOptions::names_only();
    scene::read(&project_root().join("scenes/experiment-1.toml"), &options).map_err(Failure::refused)
}
