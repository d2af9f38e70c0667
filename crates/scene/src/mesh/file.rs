//! Reading of a mesh file into one mesh.

use crate::mesh::error::{LocatedFault, MeshError, MeshFault, MeshPlace};
use crate::mesh::format::{Format, LIMIT_BYTES, MeshOptions};
use crate::mesh::{assemble, gltf_buffers, gltf_document, obj, stl};
use crate::openmaterial;
use artifact::bounded;
use artifact::scene::Mesh;
use std::path::{Path, PathBuf};

/// Reads a mesh in body axes with the file's own origin: glTF's +Z is forward, +X left, +Y up; STL and OBJ
/// are assumed to be in body axes already.
///
/// # Errors
/// Names the file, the place in it and the broken rule; `is_system` indicates a missing or unreadable file.
pub fn read_mesh(path: &Path, options: &MeshOptions) -> Result<Mesh, MeshError> {
    let located = |fault| MeshError { file: path.to_owned(), place: MeshPlace::File, fault };
    let format = Format::of(path).ok_or_else(|| located(MeshFault::UnknownFormat))?;
    let bytes = read_bytes(path).map_err(located)?;
    mesh_from_bytes(&bytes, format, path, options)
}

/// Reads the mesh in these bytes; `path` names it in errors, and buffers beside a `.gltf` are searched there.
///
/// # Errors
/// Those of [`read_mesh`].
pub fn mesh_from_bytes(
    bytes: &[u8],
    format: Format,
    path: &Path,
    options: &MeshOptions,
) -> Result<Mesh, MeshError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let parts = match format {
        Format::Glb => gltf_document::read_glb(bytes, path),
        Format::Gltf => gltf_document::read_gltf(bytes, path),
        Format::Stl => stl::read_stl(bytes),
        Format::Obj => obj::read_obj(bytes),
        Format::Asset => return Ok(Mesh { name, ..mesh_of_asset(bytes, path, options)? }),
    };
    parts
        .and_then(|parts| assemble::assemble(name, parts, options))
        .map_err(|LocatedFault { place, fault }| MeshError { file: path.to_owned(), place, fault })
}

/// The mesh of an asset's model, which is a glTF, so that there is no further recursion.
fn mesh_of_asset(bytes: &[u8], path: &Path, options: &MeshOptions) -> Result<Mesh, MeshError> {
    let model = openmaterial::model_of(bytes, path).map_err(|error| MeshError {
        file: path.to_owned(),
        place: MeshPlace::File,
        fault: MeshFault::Asset(Box::new(error)),
    })?;
    read_mesh(&model, options)
}

/// The files of a mesh: itself; for `.gltf` the buffers beside it, for `.xoma` its model and the files of its
/// materials, as far as they can be read.
pub fn files(path: &Path) -> Vec<PathBuf> {
    let beside = match Format::of(path) {
        Some(Format::Gltf) => {
            read_bytes(path).map(|bytes| gltf_buffers::files_beside(&bytes, path)).unwrap_or_default()
        }
        Some(Format::Asset) => files_of_asset(path),
        _ => vec![],
    };
    std::iter::once(path.to_owned()).chain(beside).collect()
}

fn files_of_asset(path: &Path) -> Vec<PathBuf> {
    let model = read_bytes(path).ok().and_then(|bytes| openmaterial::model_of(&bytes, path).ok());
    model.into_iter().flat_map(|model| files(&model)).chain(openmaterial::files_of_asset(path)).collect()
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, MeshFault> {
    bounded::read(path, LIMIT_BYTES).map_err(MeshFault::Unread)
}
