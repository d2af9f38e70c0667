//! Meshes from files or by the names of own vehicles, and their far-field distance.

use artifact::material::{MaterialMap, Transmission};
use artifact::scene::Mesh;
use artifact::units::SPEED_OF_LIGHT_MPS;
use pipeline::chain::loading;
use pipeline::host::failure::Failure;
use std::path::Path;

/// Reads a mesh file unchanged, or makes an own vehicle by its name.
///
/// # Errors
/// The file is missing, or contains no usable mesh; a scale for a mesh without a file.
pub fn mesh(place: &Path, unit_scale: Option<f64>) -> Result<Mesh, Failure> {
    let name = place.to_str().filter(|_| !place.exists());
    if let Some(mesh) = name.and_then(|name| scene::vehicles::mesh(name, 0)) {
        return match unit_scale {
            None => Ok(mesh),
            Some(_) => {
                let rule = "--unit-scale is for mesh files: the project's own vehicles are in metres";
                Err(Failure::System(format!("{}: {rule}", place.display())))
            }
        };
    }
    // A word without an ending that no file has was meant as a vehicle.
    if let Some(name) = name.filter(|_| place.extension().is_none() && place.components().count() == 1) {
        return Err(Failure::Refused(scene::unknown_vehicle(name).to_string()));
    }
    scene::read_mesh(place, &scene::MeshOptions { unit_scale }).map_err(loading::mesh_failure)
}

/// The mesh with the materials of a map and, if it was read from an OpenMATERIAL 3D asset, with those of the
/// asset at the middle of the frequencies.
///
/// # Errors
/// A file of the asset is missing or refused.
pub(crate) fn dressed(
    mesh: Mesh,
    place: &Path,
    map: &MaterialMap,
    frequency_hz: &[f64],
) -> Result<Mesh, Failure> {
    let map = scene::asset_materials(place, &mesh.materials, map, middle_hz(frequency_hz))
        .map_err(loading::asset_failure)?;
    Ok(Mesh { makeup: map.mesh_materials(&mesh.materials), ..mesh })
}

/// Reads a file of materials, those of OpenMATERIAL 3D at the middle of the frequencies, or none; and sets
/// whether waves are followed through their sheets.
///
/// # Errors
/// Every rule that the file breaks; the file is missing.
pub(crate) fn materials(
    file: Option<&Path>,
    transmission: Transmission,
    frequency_hz: &[f64],
) -> Result<MaterialMap, Failure> {
    let read = file.map(|file| scene::read_materials(file, middle_hz(frequency_hz))).transpose();
    Ok(MaterialMap { transmission, ..read.map_err(loading::scene_failure)?.unwrap_or_default() })
}

/// The middle between the lowest and the highest frequency, at which materials are evaluated.
fn middle_hz(frequency_hz: &[f64]) -> f64 {
    let [lowest, highest] = [f64::min, f64::max].map(|end| frequency_hz.iter().copied().reduce(end));
    0.5 * (lowest.unwrap_or(0.0) + highest.unwrap_or(0.0))
}

/// Far-field distance 2D²/λ at the highest frequency in m, D the diagonal of a box of this size.
pub(crate) fn far_field_from_m(size_m: [f64; 3], frequency_hz: &[f64]) -> f64 {
    let highest_hz = frequency_hz.iter().copied().fold(0.0, f64::max);
    2.0 * size_m.map(|side_m| side_m.powi(2)).iter().sum::<f64>() * highest_hz / SPEED_OF_LIGHT_MPS
}
