//! Models of bodies: files and the project's own vehicles and street furniture, each read once for all
//! targets that share it.

use crate::document::errors::Rule;
use crate::document::keys::bodies::{DIAMETER, HEIGHT, LENGTH, MODEL, UNIT_SCALE, VEHICLE_SEED};
use crate::document::section::Section;
use crate::mesh::{self, MeshOptions, centred, read_mesh};
use crate::models::options::{MeshLoading, ReadOptions};
use crate::models::street_furniture::read_size;
use crate::openmaterial::asset_materials;
use crate::wording::similarity::nearest;
use artifact::material::MaterialMap;
use artifact::scene::Mesh;
use artifact::settings::Class;
use bodies::{street, vehicles};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Source of a target's mesh, according to its `model`.
#[derive(Debug, Clone, PartialEq)]
enum Model {
    /// One of the project's own vehicles.
    Vehicle { name: &'static str, seed: u64 },
    /// A piece of the project's own street furniture.
    Street(street::Furniture),
    /// A mesh file, with the requested scale.
    File { path: PathBuf, unit_scale: Option<f64> },
}

impl Model {
    /// Name of the own vehicle or piece, or of the file without folders.
    fn name(&self) -> String {
        match self {
            Self::Vehicle { name, .. } => (*name).to_owned(),
            Self::Street(piece) => piece.name().to_owned(),
            Self::File { path, .. } => path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        }
    }
}

/// The meshes of a scene, in the order in which targets first name them.
pub(crate) struct Models {
    folder: PathBuf,
    options: ReadOptions,
    other_inputs: Vec<PathBuf>,
    /// Recorded traffic, a further input file.
    recording: Option<PathBuf>,
    known: Vec<Model>,
    /// Indices into `meshes`, by the debug text of the model.
    places: HashMap<String, usize>,
    meshes: Vec<Mesh>,
    triangles: usize,
    materials: MaterialMap,
    frequency_hz: f64,
}

/// Largest number of triangles of all models of a scene: the limit of one file, since one body may be the
/// whole scene.
const TRIANGLE_LIMIT: usize = 1 << 24;

/// A model as chosen by a target.
pub(crate) struct ChosenModel {
    /// Name of the own vehicle or piece, or of the file without folders.
    pub name: String,
    /// Index into the scene's meshes.
    pub mesh: u32,
    /// Class, if the model is one of the project's own vehicles.
    pub class: Option<Class>,
}

impl Models {
    /// Makes an empty library; `folder` holds the scene: relative paths start there.
    pub(crate) fn new(folder: &Path, options: &ReadOptions) -> Self {
        let (folder, options) = (folder.to_owned(), options.clone());
        Self {
            folder,
            options,
            other_inputs: vec![],
            recording: None,
            known: vec![],
            places: HashMap::new(),
            meshes: vec![],
            triangles: 0,
            materials: MaterialMap::default(),
            frequency_hz: 0.0,
        }
    }

    /// Sets the materials by name at the radar's frequency, before the first model is chosen.
    pub(crate) fn set_materials(&mut self, materials: &MaterialMap, frequency_hz: f64) {
        (self.materials, self.frequency_hz) = (materials.clone(), frequency_hz);
    }

    /// Chooses the model of a mesh target, which an option may replace; faults are noted at its key.
    pub(crate) fn choose(&mut self, target: &Section<'_>) -> Option<ChosenModel> {
        if self.options.model.is_none() {
            target.require(MODEL.name);
        }
        let written = target.read(&MODEL);
        let Some(path) = &self.options.model else { return self.choose_written(target, written?) };
        // Scale and seed belong to what is replaced; their faults are noted all the same.
        target.read(&UNIT_SCALE);
        target.read(&VEHICLE_SEED);
        let model = replacing(target, path)?;
        Some(self.chosen(target, model))
    }

    /// Chooses the model of that name, which no option replaces, with scale and seed from the section; faults
    /// are noted there.
    pub(crate) fn choose_written(&mut self, section: &Section<'_>, written: &str) -> Option<ChosenModel> {
        let (unit_scale, seed) = (section.read(&UNIT_SCALE), section.read(&VEHICLE_SEED));
        let model = named_model(section, written, &self.folder, unit_scale, seed)?;
        Some(self.chosen(section, model))
    }

    fn chosen(&mut self, target: &Section<'_>, model: Model) -> ChosenModel {
        let name = model.name();
        let said = format!("{model:?}");
        let mesh = match self.places.get(&said) {
            Some(index) => *index,
            None => {
                let index = self.add(target, model);
                self.places.insert(said, index);
                index
            }
        };
        ChosenModel { class: vehicles::class_of(&name), name, mesh: mesh as u32 }
    }

    /// A mesh file, in its own size.
    fn named_clutter(&self, clutter: &Section<'_>, written: &str) -> Option<Model> {
        for key in [LENGTH.name, HEIGHT.name, DIAMETER.name].into_iter().filter(|key| clutter.has(key)) {
            clutter.note(key, Rule::Misplaced { key, owner: "a mesh file" });
        }
        if mesh::Format::of(Path::new(written)).is_none() {
            let (found, nearest) = (written.to_owned(), nearest(written, &street::NAMES));
            clutter.note(MODEL.name, Rule::UnknownModel { found, own: "street furniture", nearest });
            return None;
        }
        let unit_scale = clutter.read(&UNIT_SCALE);
        Some(Model::File { path: self.folder.join(written), unit_scale })
    }

    /// Chooses the model of a piece of clutter, which no option replaces; faults are noted at its key.
    pub(crate) fn choose_clutter(&mut self, clutter: &Section<'_>, written: &str) -> Option<ChosenModel> {
        let model = if street::NAMES.contains(&written) {
            Model::Street(read_size(clutter, written)?)
        } else {
            self.named_clutter(clutter, written)?
        };
        Some(self.chosen(clutter, model))
    }

    /// The meshes so far; empty if only names were requested.
    pub(crate) fn meshes(&self) -> &[Mesh] {
        &self.meshes
    }

    /// Whether models are opened.
    pub(crate) fn are_opened(&self) -> bool {
        self.options.meshes == MeshLoading::Whole
    }

    /// The meshes with their materials, returned once.
    pub(crate) fn take_meshes(&mut self) -> Vec<Mesh> {
        std::mem::take(&mut self.meshes)
    }

    /// The folder where relative paths of the scene start.
    pub(crate) fn folder(&self) -> PathBuf {
        self.folder.clone()
    }

    /// Adds files that the result depends on.
    pub(crate) fn add_inputs(&mut self, files: impl IntoIterator<Item = PathBuf>) {
        self.other_inputs.extend(files);
    }

    /// Adds a file beside the scene that the result depends on.
    pub(crate) fn add_input(&mut self, written: &str) -> PathBuf {
        let path = self.folder.join(written);
        self.other_inputs.push(path.clone());
        path
    }

    /// Adds recorded traffic beside the scene.
    pub(crate) fn add_recording(&mut self, written: &str) -> PathBuf {
        let file = self.add_input(written);
        self.recording.insert(file).clone()
    }

    /// Materials of the meshes.
    pub(crate) fn materials(&self) -> &MaterialMap {
        &self.materials
    }

    /// Files that the result depends on, beside the scene, its models and its recording.
    pub(crate) fn other_inputs(&self) -> impl Iterator<Item = &PathBuf> {
        self.other_inputs.iter().filter(|file| self.recording.as_ref() != Some(*file))
    }

    /// Every file of the models and their materials.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        let paths = self.known.iter().filter_map(|model| match model {
            Model::File { path, .. } => Some(path),
            Model::Vehicle { .. } | Model::Street(_) => None,
        });
        self.other_inputs.iter().cloned().chain(paths.flat_map(|path| mesh::files(path))).collect()
    }

    fn add(&mut self, target: &Section<'_>, model: Model) -> usize {
        let mesh = match self.options.meshes {
            MeshLoading::Whole if self.triangles > TRIANGLE_LIMIT => Mesh::default(), // noted already
            MeshLoading::Whole => load(target, &model, self.options.model.as_deref()),
            MeshLoading::NamesOnly => Mesh { name: model.name(), ..Mesh::default() },
        };
        let room = TRIANGLE_LIMIT.saturating_sub(self.triangles);
        self.triangles += mesh.triangles.len();
        if mesh.triangles.len() > room {
            target.note(MODEL.name, Rule::TooManyTriangles { limit: TRIANGLE_LIMIT });
        }
        let mesh = self.with_materials(target, &model, mesh);
        self.known.push(model);
        self.meshes.push(mesh);
        self.meshes.len() - 1
    }

    /// Adds the scene's materials and those of its asset to the mesh; faults of these are noted.
    fn with_materials(&self, target: &Section<'_>, model: &Model, mesh: Mesh) -> Mesh {
        let of_asset = match model {
            // A mesh that was not read has no materials.
            Model::File { path, .. } if !mesh.materials.is_empty() => {
                asset_materials(path, &mesh.materials, &self.materials, self.frequency_hz)
                    .map_err(|error| target.note(MODEL.name, Rule::OpenMaterial(Box::new(error))))
                    .ok()
            }
            _ => None,
        };
        let makeup = of_asset.as_ref().unwrap_or(&self.materials).mesh_materials(&mesh.materials);
        Mesh { makeup, ..mesh }
    }
}

/// The model named by an option: a file in metres, or an own vehicle of the default seed. Its path need not
/// be Unicode.
fn replacing(target: &Section<'_>, path: &Path) -> Option<Model> {
    match path.to_str() {
        None if mesh::Format::of(path).is_some() => {
            Some(Model::File { path: path.to_owned(), unit_scale: None })
        }
        _ => named_model(target, &path.to_string_lossy(), Path::new(""), None, None),
    }
}

fn named_model(
    target: &Section<'_>,
    written: &str,
    folder: &Path,
    unit_scale: Option<f64>,
    seed: Option<u64>,
) -> Option<Model> {
    let name = vehicles::names().into_iter().find(|name| *name == written);
    match (name, mesh::Format::of(Path::new(written))) {
        (Some(name), _) => {
            if unit_scale.is_some() {
                let (key, owner) = (UNIT_SCALE.name, "one of the project's vehicles");
                target.note(key, Rule::Misplaced { key, owner });
            }
            Some(Model::Vehicle { name, seed: seed.unwrap_or(VEHICLE_SEED.absent.0) })
        }
        (None, Some(_)) => {
            if seed.is_some() {
                let (key, owner) = (VEHICLE_SEED.name, "a mesh file");
                target.note(key, Rule::Misplaced { key, owner });
            }
            Some(Model::File { path: folder.join(written), unit_scale })
        }
        (None, None) => {
            target.note(MODEL.name, unknown_vehicle(written));
            None
        }
    }
}

/// The rule broken by a word that is neither a file of a known format nor one of the project's vehicles.
pub fn unknown_vehicle(written: &str) -> Rule {
    let nearest = nearest(written, &vehicles::names());
    Rule::UnknownModel { found: written.to_owned(), own: "vehicles", nearest }
}

/// Loads a mesh with its origin on the ground under its middle; notes a refused one and returns an empty
/// mesh. `replacement`: the model named by an option, whose unit no key gives.
fn load(target: &Section<'_>, model: &Model, replacement: Option<&Path>) -> Mesh {
    let mesh = match model {
        Model::Vehicle { name, seed } => {
            let unknown = || Rule::UnknownModel { found: (*name).to_owned(), own: "vehicles", nearest: None };
            vehicles::mesh(name, *seed).ok_or_else(unknown)
        }
        Model::Street(piece) => Ok(street::mesh(piece)),
        Model::File { path, unit_scale } => {
            let read = read_mesh(path, &MeshOptions { unit_scale: *unit_scale });
            let is_replacement = replacement == Some(path);
            read.map_err(|error| Rule::Mesh(if is_replacement { error.of_replacement() } else { error }))
        }
    };
    let mesh = mesh.map_err(|rule| target.note(MODEL.name, rule));
    centred(mesh.unwrap_or_default())
}
