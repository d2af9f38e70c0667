//! Materials in files of their own, from one folder and at one frequency.

use crate::openmaterial::{
    FileReader, MaterialProperties, OpenMaterialError, OpenMaterialFault, material_at,
};
use crate::wording::allowed_range::AllowedRange;
use std::cell::RefCell;
use std::path::{Path, PathBuf};

/// The folder of files of materials, with all files opened there.
pub(super) struct MaterialFiles {
    folder: PathBuf,
    frequency_hz: f64,
    files: RefCell<Vec<PathBuf>>,
}

impl MaterialFiles {
    pub(super) fn new(folder: &Path, frequency_hz: f64) -> Self {
        Self { folder: folder.to_owned(), frequency_hz, files: RefCell::default() }
    }

    /// The material in a file that the user names.
    pub(super) fn material(&self, written: &str) -> Result<MaterialProperties, OpenMaterialError> {
        let mut reader = FileReader::new();
        let material = material_at(&self.folder.join(written), self.frequency_hz, &mut reader);
        self.files.borrow_mut().extend(reader.into_files());
        material
    }

    /// An error of a material whose roughness is outside a road's range.
    pub(super) fn too_rough(&self, written: &str, found: f64, allowed: AllowedRange) -> OpenMaterialError {
        let what = "a road's height in m, unless `rms_height_mm` says it,";
        OpenMaterialError {
            file: self.folder.join(written),
            place: "materialProperties.surfaceRoughness.surfaceHeightRms".to_owned(),
            fault: OpenMaterialFault::OutOfRange { what, found, allowed },
        }
    }

    /// All opened files.
    pub(super) fn into_files(self) -> Vec<PathBuf> {
        self.files.into_inner()
    }
}
