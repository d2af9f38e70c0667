//! Bodies as meshes: read from files, drawn by the project itself, and written for others to see.

pub mod mesh;
mod glb;
pub(crate) mod painted;
pub mod vehicles;
pub mod street;
