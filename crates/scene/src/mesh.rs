//! Mesh files: glTF, STL and OBJ into triangles in body axes.

mod error;
mod part;
mod assemble;
mod centre;
mod gltf_json;
mod gltf_document;
mod gltf_buffers;
mod gltf_accessor;
mod gltf_nodes;
mod stl;
mod obj;
mod polygon;

pub use centre::centred;
pub use error::{MeshError, MeshFault, MeshPlace};

use crate::errors::Allowed;
use artifact::bounded;
use artifact::scene::Mesh;
use error::Located;
use part::Part;
use std::path::{Path, PathBuf};

/// How a mesh file is read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshOptions {
    /// Metres in one unit of the file. `None`: metres, and a model below a millimetre or above a kilometre is refused,
    /// for then it is not.
    pub unit_scale: Option<f64>,
}

/// Format of a mesh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Binary glTF 2.0.
    Glb,
    /// glTF 2.0 as JSON, buffers beside it or inside.
    Gltf,
    /// Stereolithography, text or binary.
    Stl,
    /// Wavefront.
    Obj,
}

impl Format {
    /// By the file name's extension, in either case.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "glb" => Some(Self::Glb),
            "gltf" => Some(Self::Gltf),
            "stl" => Some(Self::Stl),
            "obj" => Some(Self::Obj),
            _ => None,
        }
    }
}

/// Scales from a nanometre to a thousand kilometres for one unit.
pub(crate) const UNIT_SCALES: Allowed = Allowed::Between(1e-9, 1e6);

/// The largest vehicle of film studios has some 10⁷ triangles in 10⁹ bytes; the stages would not end on it.
const LIMIT_BYTES: u64 = 1 << 30;

/// The mesh in a file, in body axes with the file's own origin: glTF's +Z is forward, +X left, +Y up; STL and OBJ are
/// taken to be in body axes already.
///
/// # Errors
/// Names the file, the place in it and the broken rule; `is_system` tells a file that is missing or unreadable.
pub fn read_mesh(path: &Path, options: &MeshOptions) -> Result<Mesh, MeshError> {
    let located = |fault| MeshError { file: path.to_owned(), place: MeshPlace::File, fault };
    let format = Format::of(path).ok_or_else(|| located(MeshFault::UnknownFormat))?;
    let bytes = read_bytes(path).map_err(located)?;
    mesh_from_bytes(&bytes, format, path, options)
}

/// The mesh in these bytes; `path` names it in errors, and buffers beside a `.gltf` are looked for there.
///
/// # Errors
/// As [`read_mesh`].
pub fn mesh_from_bytes(bytes: &[u8], format: Format, path: &Path, options: &MeshOptions) -> Result<Mesh, MeshError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    read_parts(bytes, format, path)
        .and_then(|parts| assemble::assemble(name, parts, options))
        .map_err(|Located { place, fault }| MeshError { file: path.to_owned(), place, fault })
}

/// The files that a mesh consists of: itself, and for `.gltf` the buffers beside it as far as it can be read.
pub fn files(path: &Path) -> Vec<PathBuf> {
    let beside = match Format::of(path) {
        Some(Format::Gltf) => {
            read_bytes(path).map(|bytes| gltf_buffers::files_beside(&bytes, path)).unwrap_or_default()
        }
        _ => vec![],
    };
    std::iter::once(path.to_owned()).chain(beside).collect()
}

fn read_parts(bytes: &[u8], format: Format, path: &Path) -> Result<Vec<Part>, Located> {
    match format {
        Format::Glb => gltf_document::read_glb(bytes, path),
        Format::Gltf => gltf_document::read_gltf(bytes, path),
        Format::Stl => stl::read_stl(bytes),
        Format::Obj => obj::read_obj(bytes),
    }
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, MeshFault> {
    bounded::read(path, LIMIT_BYTES).map_err(MeshFault::Unread)
}
