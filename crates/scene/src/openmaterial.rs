//! Assets and materials of ASAM OpenMATERIAL 3D: the model of an asset, and the radio properties of its
//! materials.

mod error;
mod node;
mod file_reader;
mod asset;
mod mapping;
mod table;
mod material;
mod asset_materials;

pub(crate) use asset::model_of;
pub use asset_materials::asset_materials;
pub(crate) use asset_materials::files_of_asset;
pub use error::{OpenMaterialError, OpenMaterialFault};
pub(crate) use file_reader::FileReader;
pub(crate) use material::{MaterialProperties, material_at};
