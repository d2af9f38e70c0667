//! A mapping (`.xomm`) from models' names and colours of materials to files of materials.

use crate::openmaterial::error::{OpenMaterialError, OpenMaterialFault};
use crate::openmaterial::file_reader::FileReader;
use crate::openmaterial::node::Node;
use crate::wording::excerpt::excerpt;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Reads the files of materials by name.
pub(super) fn read(
    file: &Path,
    reader: &mut FileReader,
) -> Result<BTreeMap<String, PathBuf>, OpenMaterialError> {
    let value = reader.read(file)?;
    let mut known = BTreeMap::new();
    for entry in Node::root(file, &value).need("materialMapping")?.list()? {
        let [name, material, description] = entry.tuple("a list of name, file and description")?;
        description.text()?;
        let text = name.text()?;
        if known.insert(text.to_owned(), material.reference(".xomp")?).is_some() {
            return Err(name.error(OpenMaterialFault::Twice(excerpt(text))));
        }
    }
    Ok(known)
}
