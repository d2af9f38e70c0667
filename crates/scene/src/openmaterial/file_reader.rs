//! The files that were read, each whole, of limited size and of a known version.

use crate::openmaterial::error::{OpenMaterialError, OpenMaterialFault};
use crate::openmaterial::node::Node;
use crate::wording::excerpt::excerpt;
use artifact::bounded::{self, ReadFault};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Largest file in bytes: a table of a thousand frequencies in fifty conditions.
const FILE_LIMIT_BYTES: u64 = 4 << 20;

/// Largest total of the files of one asset's materials, bytes.
const TOTAL_LIMIT_BYTES: u64 = 64 << 20;

/// Reader of the files of one asset's materials, or of one material.
pub(crate) struct FileReader {
    files: Vec<PathBuf>,
    left: u64,
}

impl FileReader {
    /// Reader that has read nothing yet.
    pub(crate) fn new() -> Self {
        Self { files: vec![], left: TOTAL_LIMIT_BYTES }
    }

    /// All opened files, in order.
    pub(crate) fn into_files(self) -> Vec<PathBuf> {
        self.files
    }

    /// Reads and parses a file.
    pub(super) fn read(&mut self, file: &Path) -> Result<Value, OpenMaterialError> {
        self.files.push(file.to_owned());
        let error = |fault| OpenMaterialError { file: file.to_owned(), place: String::new(), fault };
        let bytes = bounded::read(file, FILE_LIMIT_BYTES.min(self.left)).map_err(|fault| match fault {
            ReadFault::TooLong { limit } if limit < FILE_LIMIT_BYTES => {
                error(OpenMaterialFault::TooLongTogether { limit: TOTAL_LIMIT_BYTES })
            }
            fault => error(OpenMaterialFault::Unread(fault)),
        })?;
        self.left -= bytes.len() as u64;
        parsed(file, &bytes)
    }
}

/// Parses the bytes of a file.
pub(super) fn parsed(file: &Path, bytes: &[u8]) -> Result<Value, OpenMaterialError> {
    let root = OpenMaterialError { file: file.to_owned(), place: String::new(), fault: too_long() };
    if bytes.len() as u64 > FILE_LIMIT_BYTES {
        return Err(root);
    }
    let value: Value = serde_json::from_slice(bytes)
        .map_err(|fault| OpenMaterialError { fault: OpenMaterialFault::Json(fault), ..root })?;
    check_version(&Node::root(file, &value))?;
    Ok(value)
}

fn too_long() -> OpenMaterialFault {
    OpenMaterialFault::Unread(ReadFault::TooLong { limit: FILE_LIMIT_BYTES })
}

fn check_version(root: &Node<'_>) -> Result<(), OpenMaterialError> {
    let version = root.need("metadata")?.need("openMaterial3dVersion")?;
    let found = version.text()?;
    match found.split('.').next() {
        Some("1") => Ok(()),
        _ => Err(version.error(OpenMaterialFault::Version(excerpt(found)))),
    }
}
