//! The project's own bodies: vehicles of four classes, street furniture, and their files.
//!
//! Body axes: x forward, y left, z up; metres. The same name and seed give the same mesh to the bit.
//! [`vehicles`] makes cars, buses, trucks and motorcycles, [`street`] poles, signs, guard rails and kerbs;
//! [`coloured_glb`] writes a coloured mesh for viewers. [`road_wheels`] finds the wheels of any mesh.

mod glb; // binary glTF
mod coloured_mesh; // coloured meshes for viewers
mod revolution; // triangles of bodies of revolution
mod road_wheels; // wheels of a mesh, by the names of its parts
pub mod vehicles;
pub mod street;

pub use coloured_mesh::{ColouredLine, ColouredMesh, coloured_glb};
pub use road_wheels::{names_a_wheel, road_wheels};
