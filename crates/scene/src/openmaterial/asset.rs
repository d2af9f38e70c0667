//! An asset (`.xoma`): its model, and the lookup of the model's materials.

use crate::openmaterial::error::{OpenMaterialError, OpenMaterialFault};
use crate::openmaterial::file_reader::parsed;
use crate::openmaterial::node::Node;
use crate::wording::excerpt::excerpt;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

/// Endings of models allowed by the standard that are not read.
const OTHER_FORMATS: [&str; 5] = ["fbx", "usd", "usda", "usdc", "usdz"];

/// Part of an asset that describes materials.
pub(super) struct Asset {
    /// The mapping that it names, if any.
    pub(super) mapping: Option<PathBuf>,
    /// Names or colours to look up in the mapping, by the model's material names.
    pub(super) replaced: HashMap<String, String>,
    /// The model's material names that are specified by a texture.
    pub(super) textured: HashSet<String>,
}

impl Asset {
    /// Key in the mapping for a name of the model.
    pub(super) fn key_of<'a>(&'a self, name: &'a str) -> &'a str {
        self.replaced.get(name).map_or(name, String::as_str)
    }
}

/// Whether a file is an asset, by the ending of its name in either case.
pub(crate) fn is_asset(file: &Path) -> bool {
    file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("xoma"))
}

/// The model of an asset, a file with the asset's name beside it (OpenMATERIAL 3D, 7.2.3.1).
pub(crate) fn model_of(bytes: &[u8], file: &Path) -> Result<PathBuf, OpenMaterialError> {
    let value = parsed(file, bytes)?;
    let root = Node::root(file, &value);
    read(&root)?;
    model_beside(file).map_err(|fault| root.error(fault))
}

/// The only model beside a file, by its name.
fn model_beside(file: &Path) -> Result<PathBuf, OpenMaterialFault> {
    let is_there = |ending: &&str| file.with_extension(ending).exists();
    let name = || file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let found: Vec<&str> = ["glb", "gltf"].into_iter().filter(is_there).collect();
    match (found[..].first(), OTHER_FORMATS.into_iter().find(is_there)) {
        (Some(_), _) if found.len() > 1 => Err(OpenMaterialFault::TwoModels(name())),
        (Some(ending), _) => Ok(file.with_extension(ending)),
        (None, Some(other)) => {
            Err(OpenMaterialFault::OtherModel { found: format!("{}.{other}", name()), name: name() })
        }
        (None, None) => Err(OpenMaterialFault::NoModel(name())),
    }
}

/// Reads the part of an asset that describes materials.
pub(super) fn read(root: &Node<'_>) -> Result<Asset, OpenMaterialError> {
    if let Some(others) = root.find("externalAssetReferences")?
        && others.list()?.len() > 0
    {
        return Err(others.error(OpenMaterialFault::ExternalAssets));
    }
    let mapping = root.find("materialMappingUri")?.map(|uri| uri.reference(".xomm")).transpose()?;
    let replaced = pairs(root, "materialReplacements")?;
    let textured = pairs(root, "materialTextureAssignment")?.into_keys().collect();
    Ok(Asset { mapping, replaced, textured })
}

/// Reads a list of pairs of texts, each beginning with a material name.
fn pairs(root: &Node<'_>, key: &str) -> Result<HashMap<String, String>, OpenMaterialError> {
    let mut known = HashMap::new();
    for pair in root.find(key)?.map(|list| list.list()).transpose()?.into_iter().flatten() {
        let [name, value] = pair.tuple("a list of two texts")?;
        let (text, value) = (name.text()?, value.text()?);
        if known.insert(text.to_owned(), value.to_owned()).is_some() {
            return Err(name.error(OpenMaterialFault::Twice(excerpt(text))));
        }
    }
    Ok(known)
}
