//! Bodies that the project draws itself: vehicles of four classes, street furniture, and their files.
//!
//! Body axes: x forward, y left, z up; metres. The same name and seed give the same mesh to the bit.
//! [`vehicles`] draws cars, buses, trucks and motorcycles, [`street`] poles, signs, guard rails and kerbs;
//! [`painted_glb`] writes a coloured mesh for viewers.

mod glb; // binary glTF
mod painted; // coloured meshes for viewers
pub mod vehicles;
pub mod street;

pub use painted::{Painted, PaintedLine, painted_glb};
