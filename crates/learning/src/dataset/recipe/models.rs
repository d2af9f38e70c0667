//! `[models]` of a recipe: the project's own vehicles, mesh files, folders of them, and a folder whose
//! manifest tells classes.

use crate::dataset::recipe::error::RecipeError;
use artifact::bounded;
use artifact::material::MaterialMap;
use artifact::scene::{Mesh, SceneHeader};
use artifact::settings::Class;
use pipeline::chain::loading;
use pipeline::host::failure::Failure;
use pipeline::host::toml_text;
use scene::mesh::{self, Format, MeshOptions};
use scene::{asset_materials, centred, read_mesh, vehicles};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::slice;

/// A manifest of a thousand vehicles, with all that is told of each.
const LIMIT_BYTES: u64 = 16 << 20;

/// Content of the recipe's table `[models]`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Choice {
    /// A folder with a manifest.
    vehicles: Option<PathBuf>,
    car: Option<Vec<String>>,
    bus: Option<Vec<String>>,
    truck: Option<Vec<String>>,
    motorcycle: Option<Vec<String>>,
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
    File(Box<OfFile>),
}

struct OfFile {
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
            Source::File(of_file) => (of_file.mesh.clone(), &of_file.materials[base]),
        };
        Mesh { makeup: map.makeup(&mesh.materials), ..mesh }
    }
}

/// Name and file of a model; an own vehicle has no file.
type Named = (String, Option<PathBuf>);

/// All models of each class, in the order of the recipe; `inputs` gets the files that they were read from,
/// with hashes.
pub(super) fn read(
    choice: &Choice,
    recipe: &Path,
    bases: &[&SceneHeader],
    inputs: &mut Vec<(String, String)>,
) -> Result<BTreeMap<Class, Vec<Model>>, Failure> {
    let folder = recipe.parent().unwrap_or(Path::new("."));
    let refused = |error: RecipeError| Failure::refused(error).about(recipe);
    let named_in = |failure: Failure| failure.named_in(recipe);
    let mut all: BTreeMap<Class, Vec<Named>> = BTreeMap::new();
    if let Some(vehicles) = &choice.vehicles {
        let manifest = folder.join(vehicles).join("manifest.toml");
        let (listed, hashed) =
            loading::read_of(slice::from_ref(&manifest), || manifest_of(&manifest)).map_err(named_in)?;
        inputs.extend(hashed);
        for Entry { name, class } in listed.vehicle {
            let file = manifest.with_file_name(format!("{name}.glb"));
            all.entry(class).or_default().push((name, Some(file)));
        }
    }
    for (class, written) in choice.by_class() {
        let of_class = all.entry(class).or_default();
        for name in written {
            of_class.extend(named(class, name, folder).map_err(refused)?);
        }
    }
    check(&all, choice).map_err(refused)?;
    let mut models: BTreeMap<Class, Vec<Model>> = BTreeMap::new();
    for (class, (name, file)) in
        all.into_iter().flat_map(|(class, of)| of.into_iter().map(move |named| (class, named)))
    {
        models.entry(class).or_default().push(model(name, file, bases, inputs).map_err(named_in)?);
    }
    Ok(models)
}

impl Choice {
    fn by_class(&self) -> impl Iterator<Item = (Class, &Vec<String>)> {
        let written = |class: Class| match class {
            Class::Car => &self.car,
            Class::Bus => &self.bus,
            Class::Truck => &self.truck,
            Class::Motorcycle => &self.motorcycle,
        };
        Class::ALL.into_iter().filter_map(move |class| Some((class, written(class).as_ref()?)))
    }
}

/// Part of a folder's `manifest.toml` that is read; the file may say more.
#[derive(Deserialize)]
struct Manifest {
    vehicle: Vec<Entry>,
}

#[derive(Deserialize)]
struct Entry {
    name: String,
    class: Class,
}

fn manifest_of(file: &Path) -> Result<Manifest, Failure> {
    let text = bounded::read_text(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
    let refused = |error: RecipeError| Failure::refused(error).about(file);
    let manifest: Manifest = toml_text::read(&text).map_err(|fault| refused(fault.into()))?;
    let is_plain = |name: &str| Path::new(name).file_name().is_some_and(|own| own == name);
    match manifest.vehicle.iter().find(|entry| !is_plain(&entry.name)) {
        Some(entry) => Err(refused(RecipeError::NameOfNoFile { name: entry.name.clone() })),
        None => Ok(manifest),
    }
}

/// Word for all crosses of a class.
const ALL_CROSSES: &str = "crosses";

/// The models that a word of the recipe names: an own vehicle, all crosses, a file, or all `.glb` of a
/// folder.
fn named(class: Class, written: &str, folder: &Path) -> Result<Vec<Named>, RecipeError> {
    let (path, name) = (folder.join(written), || written.to_owned());
    if written == ALL_CROSSES {
        return Ok(vehicles::crosses_of(class).into_iter().map(|name| (name, None)).collect());
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

fn glb_files(folder: &Path) -> std::io::Result<Vec<Named>> {
    let entries = std::fs::read_dir(folder)?;
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.retain(|file| Format::of(file) == Some(Format::Glb));
    files.sort();
    Ok(files.into_iter().map(|file| (stem(&file), Some(file))).collect())
}

fn stem(file: &Path) -> String {
    file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// A class that is named has models, and a name is one model's, for splits may go by it.
fn check(all: &BTreeMap<Class, Vec<Named>>, choice: &Choice) -> Result<(), RecipeError> {
    if let Some((class, _)) = choice.by_class().find(|(_, written)| written.is_empty()) {
        return Err(RecipeError::EmptyClass(class));
    }
    if all.is_empty() {
        return Err(RecipeError::NoModels);
    }
    let mut known: BTreeMap<&String, (Class, &Option<PathBuf>)> = BTreeMap::new();
    for (class, (name, file)) in all.iter().flat_map(|(class, of)| of.iter().map(|named| (*class, named))) {
        let first = *known.entry(name).or_insert((class, file));
        if first != (class, file) {
            return Err(RecipeError::NameOfTwoModels { class, name: name.clone() });
        }
    }
    Ok(())
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
        asset_materials(&file, &mesh.materials, &base.materials, frequency_hz).map_err(loading::of_asset)
    };
    let read = || {
        let mesh = read_mesh(&file, &MeshOptions { unit_scale: None }).map_err(loading::of_mesh)?;
        let materials = bases.iter().map(|base| of_base(&mesh, base)).collect::<Result<_, Failure>>()?;
        Ok((mesh, materials))
    };
    let ((mesh, materials), hashed) = loading::read_of(&mesh::files(&file), read)?;
    inputs.extend(hashed);
    let of_file = OfFile { mesh: centred(mesh), materials };
    Ok(Model { name, source: Source::File(Box::new(of_file)) })
}
