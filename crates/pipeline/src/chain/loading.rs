//! Loading of a scene from its file, through the cache.

use crate::chain::cache::Cache;
use crate::chain::keys;
use crate::chain::loaded_model::LoadedModel;
use crate::chain::stages::Stage;
use crate::host::failure::Failure;
use crate::host::progress::{self, Work};
use crate::host::provenance_checks;
use artifact::Provenance;
use artifact::changed_inputs::HashedFile;
use artifact::scene::{Role, Scene, SceneHeader, Target};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A scene file with replacements for parts of it.
#[derive(Debug, Clone, Default)]
pub struct SceneSource {
    /// Scene file (`docs/scenes.md`).
    pub file: PathBuf,
    /// Model file in place of the model of every target.
    pub model: Option<PathBuf>,
    /// Id of the radar to use, where the scene has several.
    pub radar: Option<String>,
    /// Seed in place of the scene's.
    pub seed: Option<u64>,
    /// Accuracy in place of the scene's, dB, by which the physics is chosen ([`crate::planning`]).
    pub accuracy_db: Option<f64>,
}

/// A scene with its origin.
pub struct LoadedScene {
    /// The scene as every stage reads it.
    pub header: SceneHeader,
    /// Whether it came from the cache.
    pub cached: bool,
    /// Loading time, s.
    pub seconds: f64,
    /// Name and hash of each file that was read.
    pub files: Vec<(String, String)>,
}

/// Reads the scene, or takes it from the cache if none of its files has changed.
pub fn scene(source: &SceneSource, cache: Option<&Cache>) -> Result<LoadedScene, Failure> {
    let start = Instant::now();
    let (model, radar) = (source.model.clone(), source.radar.clone());
    let options = scene::ReadOptions { model, radar, meshes: scene::MeshLoading::Whole };
    let name = source.file.display();
    let mut seen = progress::during(format!("looking for changes of {name} and of what it names"), || {
        file_states(&scene::inputs(&source.file, &options).map_err(scene_failure)?)
    })?;
    let files: Vec<(String, String)> = seen.iter().map(|file| file.named().clone()).collect();
    // A path that is not Unicode enters the key as displayable text; the file's content is among the hashes.
    let model = source.model.as_ref().map(|file| file.to_string_lossy());
    let key = keys::scene(&files, &(model, &source.radar));
    let reading = Work::begin(format!("reading {name} and its meshes"));
    let known = cache.and_then(|c| c.get_header::<Scene>(Stage::Scene, &key));
    let cached = known.is_some();
    let mut header = match known {
        Some(header) => header,
        None => scene::read(&source.file, &options).map_err(scene_failure)?,
    };
    if !cached {
        check_unchanged(&mut seen)?; // otherwise the cache would store it under wrong hashes
    }
    check_model(source, &header)?;
    if let (Some(cache), false) = (cache, cached) {
        cache.put_header::<Scene>(Stage::Scene, &key, &header);
    }
    drop(reading);
    header.seed = seed(source.seed.unwrap_or(header.seed), source.radar.as_deref());
    Ok(LoadedScene { header, cached, seconds: start.elapsed().as_secs_f64(), files })
}

/// Refuses a replacement model if no target has a model.
fn check_model(source: &SceneSource, header: &SceneHeader) -> Result<(), Failure> {
    let is_replaced = |target: &Target| target.role == Role::Target && target.kind.mesh().is_some();
    if source.model.is_none() || header.targets.iter().any(is_replaced) {
        return Ok(());
    }
    let rule = "--model takes the place of the models of [[target]]s, and none of them is a mesh";
    Err(Failure::System(format!("{}: {rule}", source.file.display())))
}

/// Seed of the noise: the scene's, or a derived one for each of several radars.
fn seed(of_scene: u64, radar: Option<&str>) -> u64 {
    let Some(id) = radar else { return of_scene };
    artifact::seed::derived(of_scene, &format!("xtask/radar/{id}"), &[])
}

/// Reads the radar and the settings of a scene without opening its models.
pub fn radar_only(file: &Path, radar: Option<&str>) -> Result<SceneHeader, Failure> {
    radar_changed(file, radar, &[])
}

/// Reads them with some of the scene's values changed.
pub fn radar_changed(
    file: &Path,
    radar: Option<&str>,
    changes: &[scene::Change],
) -> Result<SceneHeader, Failure> {
    let radar = radar.map(str::to_owned);
    let options = scene::ReadOptions { radar, ..scene::ReadOptions::names_only() };
    scene::read_changed(file, changes, &options).map_err(scene_failure)
}

/// The files that this reading depends on, and the models that it leaves unopened.
pub fn files_of_radar(file: &Path) -> Result<Vec<PathBuf>, Failure> {
    let options = scene::ReadOptions::names_only();
    scene::inputs(file, &options).map_err(scene_failure)
}

/// Converts an error of a mesh file: a broken rule, or an error of the system.
pub fn mesh_failure(error: scene::MeshError) -> Failure {
    if error.is_system() { Failure::System(error.to_string()) } else { Failure::Refused(error.to_string()) }
}

/// Converts an error of an OpenMATERIAL 3D material: a broken rule, or an error of the system.
pub fn asset_failure(error: scene::OpenMaterialError) -> Failure {
    if error.is_system() { Failure::System(error.to_string()) } else { Failure::Refused(error.to_string()) }
}

/// Converts an error of a scene: a broken rule, or an error of the system.
pub fn scene_failure(errors: scene::SceneErrors) -> Failure {
    if errors.is_system() {
        Failure::System(errors.to_string())
    } else {
        Failure::Refused(errors.to_string())
    }
}

/// Present state of files, each with its hash.
pub fn file_states(files: &[PathBuf]) -> Result<Vec<HashedFile>, Failure> {
    files
        .iter()
        .map(|file| HashedFile::of(file).map_err(|error| Failure::system(file, "read", error)))
        .collect()
}

/// Refuses a result if one of its files has changed since its hash was taken.
///
/// # Errors
/// A file has another content now, or is gone.
pub fn check_unchanged<'a>(files: impl IntoIterator<Item = &'a mut HashedFile>) -> Result<(), Failure> {
    files.into_iter().try_for_each(|seen| match seen.is_unchanged() {
        Ok(true) => Ok(()),
        Ok(false) => Err(changed(seen.file())),
        Err(error) => Err(Failure::system(seen.file(), "read", error)),
    })
}

/// Refusal of a file that was changed between two readings.
pub fn changed(file: &Path) -> Failure {
    let rule = "was changed while this command read it; the same command takes it as it is now";
    Failure::System(format!("{}: {rule}", file.display()))
}

/// Returns the result of `read` with the names and hashes of its files: refused if one of them changed
/// meanwhile, because the hash would belong to other content.
///
/// # Errors
/// Those of `read`; a file has another content now than before, is gone, or cannot be read.
pub fn read_hashed<T>(
    files: &[PathBuf],
    read: impl FnOnce() -> Result<T, Failure>,
) -> Result<(T, Vec<(String, String)>), Failure> {
    let seen = file_states(files);
    let found = read()?; // reports more about an unreadable file
    let mut seen = seen?;
    check_unchanged(&mut seen)?;
    Ok((found, seen.iter().map(|file| file.named().clone()).collect()))
}

/// Name and content hash of files.
pub fn hashes(files: &[PathBuf]) -> Result<Vec<(String, String)>, Failure> {
    let named = |file: &PathBuf| {
        artifact::inputs::named_hash(file).map_err(|error| Failure::system(file, "read", error))
    };
    files.iter().map(named).collect()
}

/// The requested model, else the one shipped with the program; `None` if the program has no classifier.
pub fn model(asked: Option<&Path>) -> Result<Option<LoadedModel>, Failure> {
    asked.map_or_else(shipped, |place| LoadedModel::read(place).map(Some))
}

#[cfg(feature = "classifier")]
fn shipped() -> Result<Option<LoadedModel>, Failure> {
    LoadedModel::of_bytes(crate::host::default_paths::SHIPPED_MODEL).map(Some)
}

#[cfg(not(feature = "classifier"))]
fn shipped() -> Result<Option<LoadedModel>, Failure> {
    Ok(None)
}

/// Provenance of an artifact: stage, version, inputs, settings and seed. For scattering it includes the
/// bodies.
pub fn provenance(stage: Stage, header: &SceneHeader, inputs: Vec<(String, String)>) -> Provenance {
    let asked = (&header.fidelity, &header.dsp);
    let settings = match stage {
        Stage::BartRcs => {
            serde_json::to_string(&(asked.0, asked.1, provenance_checks::describe_bodies(header)))
        }
        _ => serde_json::to_string(&asked),
    };
    Provenance {
        stage: stage.name().into(),
        program_version: env!("CARGO_PKG_VERSION").into(),
        inputs,
        settings: settings.unwrap_or_default(),
        seed: header.seed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_read_of_a_file_has_the_hash_of_that_very_content() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("spec.toml");
        std::fs::write(&file, "seed = 1").unwrap();
        let files = [file.clone()];
        let read = || std::fs::read_to_string(&file).map_err(Failure::refused);
        assert_eq!(read_hashed(&files, read).unwrap(), ("seed = 1".to_owned(), hashes(&files).unwrap()));
        let and_saved = || read().inspect(|_| std::fs::write(&file, "seed = 2").unwrap());
        let refused = read_hashed(&files, and_saved).unwrap_err();
        assert!(refused.to_string().contains("spec.toml: was changed while"), "{refused}");
        std::fs::remove_file(&file).unwrap();
        assert!(matches!(read_hashed(&files, read), Err(Failure::Unplaced(_))), "it is the reader's to tell");
    }

    #[test]
    fn what_was_read_of_a_file_that_changed_meanwhile_is_refused_by_its_name() {
        let folder = tempfile::tempdir().unwrap();
        let [one, other] = ["one.obj", "other.obj"].map(|name| folder.path().join(name));
        [&one, &other].iter().for_each(|file| std::fs::write(file, "v 0 0 0").unwrap());
        let mut seen = file_states(&[one, other.clone()]).unwrap();
        check_unchanged(&mut seen).unwrap();
        std::fs::write(&other, "v 0 0 1").unwrap();
        let refused = check_unchanged(&mut seen).unwrap_err();
        assert!(matches!(refused, Failure::System(_)), "{refused}");
        assert!(refused.to_string().contains("other.obj: was changed while"), "{refused}");
        std::fs::remove_file(&other).unwrap();
        assert!(check_unchanged(&mut seen).unwrap_err().to_string().contains("other.obj: cannot read"));
    }
}
