//! From a scene file to bodies in the world: scenes, meshes, the project's own vehicles and their motion.

mod errors;
mod keys;
mod document;
mod read;
mod radar;
mod array;
mod settings;
mod targets;
mod models;
mod motion;
pub mod mesh;
pub mod vehicles;

pub use errors::{Allowed, MapAxis, Place, Position, Rule, SceneError, SceneErrors};
pub use keys::{TABLES, Table};
pub use mesh::{MeshError, MeshOptions, centred, read_mesh};
pub use motion::{pose_after, snapshot};
pub use read::{Meshes, ReadOptions, inputs, read};
