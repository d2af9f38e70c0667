//! Formats of mesh files, and reading options.

use crate::wording::allowed_range::AllowedRange;
use std::path::Path;

/// Options for reading a mesh file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshOptions {
    /// Metres per unit of the file; `None` for a file in metres, where a model below a millimetre or above a
    /// kilometre is refused as implausible.
    pub unit_scale: Option<f64>,
}

/// Format of a mesh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Binary glTF 2.0.
    Glb,
    /// Text glTF 2.0: JSON, buffers beside it or inside.
    Gltf,
    /// Stereolithography, text or binary.
    Stl,
    /// Wavefront OBJ, text.
    Obj,
    /// Asset of OpenMATERIAL 3D: JSON beside a glTF of the same name.
    Asset,
}

impl Format {
    /// Format by the file name's extension, in either case.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "glb" => Some(Self::Glb),
            "gltf" => Some(Self::Gltf),
            "stl" => Some(Self::Stl),
            "obj" => Some(Self::Obj),
            "xoma" => Some(Self::Asset),
            _ => None,
        }
    }
}

/// Metres per unit, from a nanometre to a thousand kilometres.
pub(crate) const UNIT_SCALES: AllowedRange = AllowedRange::Between(1e-9, 1e6);

/// Largest file: the largest vehicles of film studios have some 10⁷ triangles in 10⁹ bytes, for which the
/// stages would not end.
pub(crate) const LIMIT_BYTES: u64 = 1 << 30;
