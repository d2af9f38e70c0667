//! Radio properties of a material (`.xomp`).

use crate::openmaterial::error::{OpenMaterialError, OpenMaterialFault};
use crate::openmaterial::file_reader::FileReader;
use crate::openmaterial::node::Node;
use crate::openmaterial::table;
use crate::wording::allowed_range::AllowedRange;
use artifact::material::Material;
use num_complex::Complex64;
use std::path::{Path, PathBuf};

/// A material at a frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MaterialProperties {
    /// Relative permittivity ε′ − jε″; `None` is a conductor.
    pub(crate) permittivity: Option<Complex64>,
    /// Root mean square of the surface's height, if specified by the file.
    pub(crate) rms_height_m: Option<f64>,
}

/// RMS heights, from a mirror to a boulder.
const HEIGHTS_M: AllowedRange = AllowedRange::Between(0.0, 1e3);

impl MaterialProperties {
    /// A body filled with the material.
    pub(crate) fn filled(self) -> Material {
        self.permittivity.map_or(Material::Conductor, |permittivity| Material::HalfSpace { permittivity })
    }
}

/// Reads the material in a file at a frequency.
pub(crate) fn material_at(
    file: &Path,
    frequency_hz: f64,
    reader: &mut FileReader,
) -> Result<MaterialProperties, OpenMaterialError> {
    let value = reader.read(file)?;
    let properties = Node::root(file, &value).need("materialProperties")?;
    let rms_height_m = rms_height_m(&properties)?;
    let permittivity = table::read(&named_table(&properties)?, frequency_hz, reader)?;
    Ok(MaterialProperties { permittivity, rms_height_m })
}

/// The table of electromagnetic properties of a material.
pub(super) fn table_of(file: &Path, reader: &mut FileReader) -> Result<PathBuf, OpenMaterialError> {
    let value = reader.read(file)?;
    named_table(&Node::root(file, &value).need("materialProperties")?)
}

fn named_table(properties: &Node<'_>) -> Result<PathBuf, OpenMaterialError> {
    match properties.find("electromagneticPropertiesUri")? {
        Some(uri) => uri.reference("_emp.xompt"),
        None => Err(properties.error(OpenMaterialFault::NoProperties)),
    }
}

fn rms_height_m(properties: &Node<'_>) -> Result<Option<f64>, OpenMaterialError> {
    let Some(roughness) = properties.find("surfaceRoughness")? else { return Ok(None) };
    let height = roughness.need("surfaceHeightRms")?;
    let (found, allowed) = (height.number()?, HEIGHTS_M);
    match allowed.holds(found) {
        true => Ok(Some(found)),
        false => Err(height.error(OpenMaterialFault::OutOfRange { what: "the height in m", found, allowed })),
    }
}
