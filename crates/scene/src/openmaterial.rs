//! Assets and materials of ASAM OpenMATERIAL 3D: the model of an asset, and the radio properties of its
//! materials.

mod error;
mod node;
mod library;
mod asset;
mod mapping;
mod table;
mod material;
mod of_asset;

pub(crate) use asset::model_of;
pub use error::{OpenMaterialError, OpenMaterialFault};
pub(crate) use library::Library;
pub(crate) use material::{KnownMaterial, material_at};
pub use of_asset::asset_materials;
pub(crate) use of_asset::files_of_asset;
