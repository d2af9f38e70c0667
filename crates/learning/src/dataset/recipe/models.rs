//! `[models]` of a recipe: the project's own vehicles, mesh files, folders of them, and a folder whose
//! manifest tells classes.

use crate::dataset::recipe::error::RecipeError;
use crate::dataset::recipe::keys;
use crate::dataset::recipe::manifest::{self, ManifestVehicle};
use artifact::material::MaterialMap;
use artifact::scene::{Mesh, SceneHeader};
use artifact::settings::Class;
use pipeline::chain::loading;
use pipeline::host::failure::Failure;
use scene::document::section::Section;
use scene::mesh::{self, Format, MeshOptions};
use scene::{asset_materials, centred, read_mesh, vehicles};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::slice;

/// Content of the recipe's table `[models]`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ModelChoice {
    /// A folder with a manifest.
    vehicles: Option<PathBuf>,
    /// Words for each class that is named.
    by_class: BTreeMap<Class, Vec<String>>,
}

impl ModelChoice {
    /// The table's content; unknown keys and wrong types are noted.
    pub(super) fn of(models: &Section<'_>) -> Self {
        let words = |class: Class| {
            let key = match class {
                Class::Car => &keys::CAR,
                Class::Bus => &keys::BUS,
                Class::Truck => &keys::TRUCK,
                Class::Motorcycle => &keys::MOTORCYCLE,
            };
            Some((class, models.read(key)?.into_iter().map(str::to_owned).collect()))
        };
        Self {
            vehicles: models.read(&keys::VEHICLES).map(PathBuf::from),
            by_class: Class::ALL.into_iter().filter_map(words).collect(),
        }
    }
}

/// A body that a recipe may draw.
pub(in crate::dataset) struct Model {
    /// Name of the project's own vehicle, or of the file without its ending.
    pub(in crate::dataset) name: String,
    source: Source,
}

enum Source {
    /// One of the project's vehicles.
    Own,
    File(Box<FileModel>),
}

struct FileModel {
    mesh: Mesh,
    /// Each base scene's materials, with the file's own.
    materials: Vec<MaterialMap>,
}

impl Model {
    /// Whether there is more than one variant of it.
    pub(in crate::dataset) fn has_variants(&self) -> bool {
        matches!(self.source, Source::Own)
    }

    /// Mesh of a variant in a scene's axes, with the materials of base scene number `base`, and its own.
    pub(in crate::dataset) fn mesh(&self, variant: u64, base: usize, header: &SceneHeader) -> Mesh {
        let (mesh, map) = match &self.source {
            Source::Own => (vehicles::mesh(&self.name, variant).unwrap_or_default(), &header.materials),
            Source::File(file_model) => (file_model.mesh.clone(), &file_model.materials[base]),
        };
        Mesh { makeup: map.mesh_materials(&mesh.materials), ..mesh }
    }
}

/// Names and files of models; an own vehicle has no file.
pub(super) type ModelFiles = BTreeMap<Class, Vec<(String, Option<PathBuf>)>>;

/// Vehicles listed by the folder's manifest; its file and hash are added to `inputs`.
pub(super) fn listed(
    choice: &ModelChoice,
    recipe: &Path,
    inputs: &mut Vec<(String, String)>,
) -> Result<ModelFiles, Failure> {
    let mut all = ModelFiles::new();
    let Some(vehicles) = &choice.vehicles else { return Ok(all) };
    let folder = recipe.parent().unwrap_or(Path::new("."));
    let manifest = folder.join(vehicles).join("manifest.toml");
    let read = || manifest::read(&manifest);
    let (listed, hashed) =
        loading::read_hashed(slice::from_ref(&manifest), read).map_err(|failure| failure.named_in(recipe))?;
    inputs.extend(hashed);
    for ManifestVehicle { name, class } in listed {
        let file = manifest.with_file_name(format!("{name}.glb"));
        all.entry(class).or_default().push((name, Some(file)));
    }
    Ok(all)
}

/// All models of each class, those that a manifest lists and then those of the recipe in its order; noted is
/// what names none, and what a split could not part.
pub(super) fn named(
    choice: &ModelChoice,
    listed: ModelFiles,
    folder: &Path,
    models: &Section<'_>,
) -> ModelFiles {
    let mut all = listed;
    for (class, written) in &choice.by_class {
        let of_class = all.entry(*class).or_default();
        for (number, word) in written.iter().enumerate() {
            match of_word(*class, word, folder) {
                Ok(named) => of_class.extend(named),
                Err(broken) => models.note_element(class.name(), number, broken.into()),
            }
        }
    }
    if all.is_empty() && models.exists() && !Class::ALL.iter().any(|class| models.has(class.name())) {
        models.note(keys::VEHICLES.name, RecipeError::NoModels.into());
    }
    check_names(&all, models);
    all
}

/// The models, opened; `inputs` gets the files that they were read from, with hashes.
pub(super) fn read(
    named: ModelFiles,
    bases: &[&SceneHeader],
    inputs: &mut Vec<(String, String)>,
) -> Result<BTreeMap<Class, Vec<Model>>, Failure> {
    let mut models: BTreeMap<Class, Vec<Model>> = BTreeMap::new();
    for (class, (name, file)) in
        named.into_iter().flat_map(|(class, of)| of.into_iter().map(move |named| (class, named)))
    {
        models.entry(class).or_default().push(model(name, file, bases, inputs)?);
    }
    Ok(models)
}

/// Word for all own vehicles of a class, in the order of the catalogue.
const ALL_OWN: &str = "own";
/// Word for all crosses of a class.
const ALL_CROSSES: &str = "crosses";

/// Own vehicles that a word for many of them stands for; `None` for any other word.
fn many(class: Class, written: &str) -> Option<Vec<String>> {
    match written {
        ALL_CROSSES => Some(vehicles::crosses_of(class)),
        ALL_OWN => {
            let own = vehicles::names().into_iter().filter(|name| vehicles::class_of(name) == Some(class));
            Some(own.map(str::to_owned).collect())
        }
        _ => None,
    }
}

/// The models that a word of the recipe names: an own vehicle, all of them, all crosses, a file, or all
/// `.glb` of a folder.
fn of_word(
    class: Class,
    written: &str,
    folder: &Path,
) -> Result<Vec<(String, Option<PathBuf>)>, RecipeError> {
    let (path, name) = (folder.join(written), || written.to_owned());
    if let Some(names) = many(class, written) {
        return Ok(names.into_iter().map(|name| (name, None)).collect());
    }
    match vehicles::class_of(written) {
        Some(own) if own == class => return Ok(vec![(name(), None)]),
        Some(own) => return Err(RecipeError::VehicleOfAnotherClass { class, name: name(), own }),
        None if path.is_dir() => {
            return match glb_files(&path) {
                Ok(none) if none.is_empty() => Err(RecipeError::NoMeshInFolder { class, name: name() }),
                Ok(files) => Ok(files),
                Err(cause) => Err(RecipeError::UnreadableFolder { class, name: name(), cause }),
            };
        }
        None => {}
    }
    match Format::of(&path) {
        Some(_) => Ok(vec![(stem(&path), Some(path))]),
        None => Err(RecipeError::NoModel { class, name: name(), own: vehicles::names() }),
    }
}

fn glb_files(folder: &Path) -> std::io::Result<Vec<(String, Option<PathBuf>)>> {
    let entries = std::fs::read_dir(folder)?;
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.retain(|file| Format::of(file) == Some(Format::Glb));
    files.sort();
    Ok(files.into_iter().map(|file| (stem(&file), Some(file))).collect())
}

fn stem(file: &Path) -> String {
    file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// Notes names of two models, for splits may go by names.
fn check_names(all: &ModelFiles, models: &Section<'_>) {
    let mut known: BTreeMap<&String, (Class, &Option<PathBuf>)> = BTreeMap::new();
    for (class, (name, file)) in all.iter().flat_map(|(class, of)| of.iter().map(|named| (*class, named))) {
        let first = *known.entry(name).or_insert((class, file));
        if first != (class, file) {
            let broken = RecipeError::NameOfTwoModels { class, name: name.clone() };
            models.note(class.name(), broken.into());
        }
    }
}

fn model(
    name: String,
    file: Option<PathBuf>,
    bases: &[&SceneHeader],
    inputs: &mut Vec<(String, String)>,
) -> Result<Model, Failure> {
    let Some(file) = file else { return Ok(Model { name, source: Source::Own }) };
    let of_base = |mesh: &Mesh, base: &SceneHeader| {
        let frequency_hz = base.radar.waveform.centre_frequency_hz();
        asset_materials(&file, &mesh.materials, &base.materials, frequency_hz).map_err(loading::asset_failure)
    };
    let read = || {
        let mesh = read_mesh(&file, &MeshOptions { unit_scale: None }).map_err(loading::mesh_failure)?;
        let materials = bases.iter().map(|base| of_base(&mesh, base)).collect::<Result<_, Failure>>()?;
        Ok((mesh, materials))
    };
    let ((mesh, materials), hashed) = loading::read_hashed(&mesh::files(&file), read)?;
    inputs.extend(hashed);
    let file_model = FileModel { mesh: centred(mesh), materials };
    Ok(Model { name, source: Source::File(Box::new(file_model)) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn own_stands_for_all_vehicles_of_the_class_in_the_order_of_the_catalogue() {
        for class in Class::ALL {
            let names = of_word(class, "own", Path::new(".")).unwrap();
            let prefix = format!("{}-", class.name());
            let of_class = vehicles::names().into_iter().filter(|name| name.starts_with(&prefix));
            assert_eq!(names, of_class.map(|name| (name.to_owned(), None)).collect::<Vec<_>>());
            assert!(names.len() > 12, "{class:?}");
        }
    }
}
