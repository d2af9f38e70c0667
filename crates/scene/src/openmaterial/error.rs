//! Faults of the files of OpenMATERIAL 3D.

use crate::wording::allowed_range::AllowedRange;
use crate::wording::number::WrittenNumber;
use artifact::bounded::ReadFault;
use std::fmt;
use std::path::PathBuf;

/// A file of OpenMATERIAL 3D that was refused or could not be read.
#[derive(Debug)]
pub struct OpenMaterialError {
    /// File of the asset.
    pub file: PathBuf,
    /// Keys and indices, from 0, of the place; empty for the whole file.
    pub place: String,
    /// Fault at that place.
    pub fault: OpenMaterialFault,
}

impl OpenMaterialError {
    /// Whether the system failed (a file is missing or unreadable), not the content.
    pub fn is_system(&self) -> bool {
        match &self.fault {
            OpenMaterialFault::Unread(error) => error.is_system(),
            OpenMaterialFault::NoModel { .. } => true,
            _ => false,
        }
    }
}

impl fmt::Display for OpenMaterialError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (file, place, fault) = (self.file.display(), &self.place, &self.fault);
        if place.is_empty() { write!(f, "{file}: {fault}") } else { write!(f, "{file}: {place}: {fault}") }
    }
}

impl std::error::Error for OpenMaterialError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.fault)
    }
}

/// Broken rules of OpenMATERIAL 3D.
#[derive(Debug, thiserror::Error)]
pub enum OpenMaterialFault {
    /// The file cannot be read, or exceeds the size limit.
    #[error("{0}")]
    Unread(#[source] ReadFault),
    /// The files of one asset together exceed the size limit.
    #[error("the files of its asset have more than {limit} bytes together, the most that are read")]
    TooLongTogether {
        /// Largest number of bytes.
        limit: u64,
    },
    /// The text is not JSON; the sentence has line and column.
    #[error("is no JSON: {0}")]
    Json(#[source] serde_json::Error),
    /// A required key is missing.
    #[error("key `{0}` is missing")]
    Missing(&'static str),
    /// A value of the wrong kind.
    #[error("must be {expected}, is {found}")]
    Expected {
        /// Kind required by the standard.
        expected: &'static str,
        /// Kind or beginning of the value.
        found: String,
    },
    /// A number outside its range.
    #[error("{what} must be {allowed}, is {}", WrittenNumber(*.found))]
    OutOfRange {
        /// Quantity and its unit.
        what: &'static str,
        /// Number in the file.
        found: f64,
        /// Range of the quantity.
        allowed: AllowedRange,
    },
    /// An unknown version of the standard.
    #[error("is of version `{0}` of OpenMATERIAL 3D; versions 1 are read")]
    Version(String),
    /// A reference that is not a relative path.
    #[error("`{0}` is no relative path to a file")]
    Malformed(String),
    /// A reference to a place outside the folder.
    #[error(
        "`{0}` leads elsewhere: files in the folder of this one and below it are read alone; no absolute \
         path, no `..`, no `\\`, no `:`"
    )]
    Outside(String),
    /// A reference to a file of another kind.
    #[error("`{found}` must end in `{ending}`")]
    Ending {
        /// Reference in the file.
        found: String,
        /// Ending required by the standard.
        ending: &'static str,
    },
    /// No model beside the asset.
    #[error("has no model beside it: neither {0}.glb nor {0}.gltf is there")]
    NoModel(String),
    /// A model in an unsupported format.
    #[error("its model {found} is of a format that is not read: write it as glTF, beside it as {name}.glb")]
    OtherModel {
        /// Name of the file.
        found: String,
        /// Name of asset and model, without their endings.
        name: String,
    },
    /// Two models beside the asset.
    #[error("has two models beside it, {0}.glb and {0}.gltf: leave one of them")]
    TwoModels(String),
    /// An asset that consists of several.
    #[error("is put together from other assets, which is not done here: join them in one model")]
    ExternalAssets,
    /// A material that is not in the mapping.
    #[error(
        "maps no material `{key}`, which `{name}` of the model{} looks for: map it, or name it in \
         [materials]", and_others(*.others)
    )]
    Unmapped {
        /// Name of the material in the model.
        name: String,
        /// Name or colour to look up in the mapping.
        key: String,
        /// Number of further unmapped materials of the model.
        others: usize,
    },
    /// A material specified by the colours of a picture.
    #[error("material `{0}` is told by the colours of a texture, which are not read: name it in [materials]")]
    Textured(String),
    /// A duplicate name.
    #[error("`{0}` is there twice")]
    Twice(String),
    /// A material without a table of its radio properties.
    #[error("names no electromagnetic properties (`electromagneticPropertiesUri`): name it in [materials]")]
    NoProperties,
    /// A table without a permittivity.
    #[error("has no row with a permittivity")]
    NoPermittivity,
    /// Rows with and without a wavelength.
    #[error("some rows have a wavelength and others have none")]
    MixedWavelengths,
    /// A table for other frequencies.
    #[error(
        "knows {} to {} GHz, and {} GHz are asked for, which is {percent} % beyond or more: name it in \
         [materials]", ghz(*.low_hz), ghz(*.high_hz), ghz(*.asked_hz)
    )]
    OtherFrequencies {
        /// Lowest frequency of the table.
        low_hz: f64,
        /// Highest frequency of the table.
        high_hz: f64,
        /// Frequency of the radar.
        asked_hz: f64,
        /// Part of a frequency by which it may be outside a table, in per cent.
        percent: f64,
    },
    /// A magnetic dielectric.
    #[error("has a relative permeability of {} − {}j, and that of dielectrics is taken to be 1", WrittenNumber(.0[0]), WrittenNumber(.0[1]))]
    Magnetic([f64; 2]),
}

fn and_others(others: usize) -> String {
    if others == 0 { String::new() } else { format!(" (and {others} more are not mapped)") }
}

fn ghz(frequency_hz: f64) -> f64 {
    (frequency_hz * 1e-6).round() / 1e3
}
