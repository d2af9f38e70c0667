//! Materials of an asset's model.

use crate::openmaterial::asset::{self, Asset};
use crate::openmaterial::error::{OpenMaterialError, OpenMaterialFault};
use crate::openmaterial::file_reader::FileReader;
use crate::openmaterial::mapping;
use crate::openmaterial::material::{material_at, table_of};
use crate::openmaterial::node::Node;
use crate::wording::excerpt::excerpt;
use artifact::material::{Material, MaterialMap};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::path::{Path, PathBuf};

/// The materials of a mesh file with the given material names: those of the map and, if the file is an asset,
/// those of its mapping at the given frequency for names that are not in the map. Meshes of other formats,
/// parts without a material, and assets without a mapping add nothing.
///
/// # Errors
/// Names the file, the place in it and the broken rule; `is_system` indicates a missing or unreadable file.
pub fn asset_materials(
    mesh_file: &Path,
    names: &[String],
    map: &MaterialMap,
    frequency_hz: f64,
) -> Result<MaterialMap, OpenMaterialError> {
    let mut all = map.clone();
    if !asset::is_asset(mesh_file) {
        return Ok(all);
    }
    let known: HashSet<&String> = map.by_name.iter().map(|(name, _)| name).collect();
    let open: Vec<&String> = names.iter().filter(|name| !name.is_empty() && !known.contains(name)).collect();
    let mut reader = FileReader::new();
    let mut materials: HashMap<PathBuf, Material> = HashMap::new();
    for (name, file) in mapped(mesh_file, &open, &mut reader)? {
        let material = match materials.get(&file) {
            Some(material) => material.clone(),
            None => material_at(&file, frequency_hz, &mut reader)?.filled(),
        };
        all.by_name.push((name.clone(), material.clone()));
        materials.insert(file, material);
    }
    Ok(all)
}

/// The file of each name's material; none if the asset has no mapping.
fn mapped<'n>(
    file: &Path,
    names: &[&'n String],
    reader: &mut FileReader,
) -> Result<Vec<(&'n String, PathBuf)>, OpenMaterialError> {
    let value = reader.read(file)?;
    let root = Node::root(file, &value);
    let asset = asset::read(&root)?;
    if let Some(name) = names.iter().find(|name| asset.textured.contains(**name)) {
        return Err(root.error(OpenMaterialFault::Textured(excerpt(name))));
    }
    let Some(mapping) = &asset.mapping else { return Ok(vec![]) };
    let files = mapping::read(mapping, reader)?;
    let found = |name: &&'n String| Some((*name, files.get(asset.key_of(name))?.clone()));
    let all: Vec<_> = names.iter().filter_map(found).collect();
    match unmapped(&asset, names, &files) {
        None => Ok(all),
        Some(fault) => {
            Err(OpenMaterialError { file: mapping.clone(), place: "materialMapping".to_owned(), fault })
        }
    }
}

/// The first name that is not in a mapping, and the number of others.
fn unmapped(
    asset: &Asset,
    names: &[&String],
    files: &BTreeMap<String, PathBuf>,
) -> Option<OpenMaterialFault> {
    let mut missing = names.iter().filter(|name| !files.contains_key(asset.key_of(name)));
    let name = missing.next()?;
    let (key, name) = (excerpt(asset.key_of(name)), excerpt(name));
    Some(OpenMaterialFault::Unmapped { name, key, others: missing.count() })
}

/// The files of an asset's materials, as far as they can be read; all files of a mapping, whether the model
/// needs them or not.
pub(crate) fn files_of_asset(file: &Path) -> Vec<PathBuf> {
    let mut reader = FileReader::new();
    let mapping =
        reader.read(file).ok().and_then(|value| asset::read(&Node::root(file, &value)).ok()?.mapping);
    let Some(mapping) = mapping else { return vec![] };
    let materials = mapping::read(&mapping, &mut reader).unwrap_or_default();
    let distinct: BTreeSet<PathBuf> = materials.into_values().collect();
    let tables: BTreeSet<PathBuf> =
        distinct.iter().filter_map(|material| table_of(material, &mut reader).ok()).collect();
    let all = std::iter::once(mapping).chain(distinct).chain(tables);
    all.filter(|file| file.is_file()).collect()
}
