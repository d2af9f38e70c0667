//! Mesh files: reads glTF, STL and OBJ into triangles in body axes.

mod format;
mod error;
mod part;
mod centre;
mod assemble;
mod gltf_json;
mod gltf_buffers;
mod gltf_accessor;
mod gltf_nodes;
mod gltf_document;
mod polygon;
mod obj;
mod stl;
mod file;

pub use centre::centred;
pub use error::{MeshError, MeshFault, MeshPlace};
pub use file::{files, mesh_from_bytes, read_mesh};
pub(crate) use format::UNIT_SCALES;
pub use format::{Format, MeshOptions};
