//! A dataset's recipe, `SPEC.toml`; its keys are in `docs/datasets.md`.

use crate::chain::loading;
use crate::host::failure::Failure;
use crate::program::commands::learning::dataset::models::{self, Choice, Model};
use crate::program::commands::learning::dataset::rules;
use artifact::bounded;
use artifact::scene::SceneHeader;
use artifact::settings::Class;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A recipe is a page of text.
const LIMIT_BYTES: u64 = 4 << 20;

/// What the file says.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Document {
    scene: Option<PathBuf>,
    #[serde(default)]
    scenes: Vec<PathBuf>,
    seed: u64,
    pub(super) scenes_per_class: u32,
    #[serde(default = "some")]
    pub(super) scenes_per_shard: u32,
    pub(super) range_m: [f64; 2],
    pub(super) speed_mps: [f64; 2],
    pub(super) lanes: Vec<u8>,
    #[serde(default = "one")]
    pub(super) vehicle_seeds: u64,
    #[serde(default)]
    pub(super) yaw_deg: [f64; 2],
    #[serde(default)]
    pub(super) offset_m: [f64; 2],
    pub(super) radar_height_m: Option<[f64; 2]>,
    pub(super) tilt_deg: Option<[f64; 2]>,
    #[serde(default)]
    pub(super) extra_noise_db: [f64; 2],
    #[serde(default = "one")]
    pub(super) frames: u32,
    pub(super) frame_interval_s: Option<f64>,
    #[serde(default = "alone")]
    pub(super) vehicles_per_scene: [u32; 2],
    #[serde(default)]
    pub(super) queue_share: f64,
    #[serde(default = "kept")]
    pub(super) crops: bool,
    models: Choice,
}

fn one<T: From<u8>>() -> T {
    T::from(1)
}

fn some() -> u32 {
    64
}

fn alone() -> [u32; 2] {
    [1, 1]
}

fn kept() -> bool {
    true
}

/// A scene of which radar, noise, processing and fidelity are taken; its own targets are not used.
pub(super) struct Base {
    /// Of the file.
    pub(super) name: String,
    pub(super) header: SceneHeader,
}

/// A recipe, checked.
pub(super) struct Recipe {
    /// What it says of the draws.
    pub(super) asked: Document,
    pub(super) bases: Vec<Base>,
    pub(super) models: BTreeMap<Class, Vec<Model>>,
    pub(super) seed: u64,
    /// The files it was read from, with hashes; itself first.
    pub(super) inputs: Vec<(String, String)>,
    pub(super) text: String,
}

impl Recipe {
    pub(super) fn read(file: &Path, seed: Option<u64>) -> Result<Self, Failure> {
        let text = bounded::read_text(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
        let refused = |rule: String| Failure::Refused(format!("{}: {rule}", file.display()));
        let asked: Document = toml::from_str(&text).map_err(|e| refused(e.to_string()))?;
        let folder = file.parent().unwrap_or(Path::new("."));
        let mut files = vec![file.to_owned()];
        let mut bases = Vec::new();
        for scene in asked.base_scenes().map_err(refused)? {
            let scene = folder.join(scene);
            bases.push(base(&scene)?);
            files.extend(loading::files_of_radar(&scene)?);
        }
        rules::check(&asked, &bases).map_err(refused)?;
        let models = models::read(&asked.models, file, folder, &mut files)?;
        let seed = seed.unwrap_or(asked.seed);
        Ok(Self { inputs: loading::hashed(&files)?, asked, bases, models, seed, text })
    }

    /// Whether a recipe of that text, read from those inputs, draws the same scenes; how many of them is left open, as more
    /// scenes leave the first ones as they are.
    pub(super) fn draws_as(&self, text: &str, inputs: &[(String, String)]) -> bool {
        let open = |text: &str| toml::from_str::<Document>(text).map(|known| Document { scenes_per_class: 0, ..known });
        let is_same = matches!((open(text), open(&self.text)), (Ok(its), Ok(own)) if its == own);
        let hashes =
            |inputs: &[(String, String)]| inputs.iter().skip(1).map(|(_, hash)| hash.clone()).collect::<Vec<_>>();
        is_same && hashes(inputs) == hashes(&self.inputs)
    }
}

impl Document {
    /// One by `scene`, several by `scenes`.
    fn base_scenes(&self) -> Result<Vec<&Path>, String> {
        match (&self.scene, self.scenes.as_slice()) {
            (Some(scene), []) => Ok(vec![scene]),
            (None, []) => Err("scene or scenes: name the base scene, or several".into()),
            (None, several) => Ok(several.iter().map(PathBuf::as_path).collect()),
            (Some(_), _) => Err("scene and scenes: give one of the two keys, not both".into()),
        }
    }
}

fn base(scene: &Path) -> Result<Base, Failure> {
    let name = scene.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(Base { name, header: loading::radar_only(scene, None)? })
}
