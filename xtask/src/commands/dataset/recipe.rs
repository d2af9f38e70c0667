//! A dataset's recipe, `SPEC.toml`; its keys are in `docs/datasets.md`.

use crate::commands::load;
use crate::failure::Failure;
use artifact::bounded;
use artifact::scene::SceneHeader;
use artifact::settings::Class;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A recipe is a page of text.
const LIMIT_BYTES: u64 = 4 << 20;
/// At a second a scene that is a week and a half for each class.
const SCENES_LIMIT: u32 = 1_000_000;

/// What the file says.
#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    scene: PathBuf,
    seed: u64,
    scenes_per_class: u32,
    range_m: [f64; 2],
    speed_mps: [f64; 2],
    lanes: Vec<u8>,
    vehicle_seeds: u64,
    models: BTreeMap<Class, Vec<String>>,
}

/// A recipe, checked.
pub(super) struct Recipe {
    /// Radar, noise, processing and fidelity; its own targets are not used.
    pub(super) base: SceneHeader,
    pub(super) seed: u64,
    pub(super) scenes_per_class: u32,
    pub(super) range_m: [f64; 2],
    pub(super) speed_mps: [f64; 2],
    pub(super) lanes: Vec<u8>,
    pub(super) vehicle_seeds: u64,
    pub(super) models: BTreeMap<Class, Vec<String>>,
    /// The files it was read from, with hashes.
    pub(super) inputs: Vec<(String, String)>,
    pub(super) text: String,
}

impl Recipe {
    pub(super) fn read(file: &Path, seed: Option<u64>) -> Result<Self, Failure> {
        let text = bounded::read_text(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
        let refused = |rule: String| Failure::Refused(format!("{}: {rule}", file.display()));
        let document: Document = toml::from_str(&text).map_err(|e| refused(e.to_string()))?;
        let scene = file.parent().unwrap_or(Path::new(".")).join(&document.scene);
        let base = load::radar_only(&scene, None)?;
        check(&document, &base).map_err(refused)?;
        Ok(Self {
            inputs: load::hashed(&[file.to_owned(), scene])?, // in this order, see `draws_as`
            seed: seed.unwrap_or(document.seed),
            scenes_per_class: document.scenes_per_class,
            range_m: document.range_m,
            speed_mps: document.speed_mps,
            lanes: document.lanes,
            vehicle_seeds: document.vehicle_seeds,
            models: document.models,
            base,
            text,
        })
    }
}

impl Recipe {
    /// Whether a recipe of that text, read from those inputs, draws the same scenes; how many of them is left open, as more
    /// scenes leave the first ones as they are.
    pub(super) fn draws_as(&self, text: &str, inputs: &[(String, String)]) -> bool {
        let open = |text: &str| toml::from_str::<Document>(text).map(|known| Document { scenes_per_class: 0, ..known });
        let is_same = matches!((open(text), open(&self.text)), (Ok(its), Ok(own)) if its == own);
        let base_scene = |inputs: &[(String, String)]| inputs.get(1).map(|(_, hash)| hash.clone());
        is_same && base_scene(inputs) == base_scene(&self.inputs)
    }
}

fn check(document: &Document, base: &SceneHeader) -> Result<(), String> {
    // As far and as fast as a scene's targets.
    for (name, [low, high], most) in [("range_m", document.range_m, 1e5), ("speed_mps", document.speed_mps, 340.0)] {
        if !(low > 0.0 && high >= low && high <= most) {
            return Err(format!("{name} must be [least, greatest], positive, at most {most}, is [{low}, {high}]"));
        }
    }
    let known = |lane: &u8| base.dsp.road.lanes.iter().any(|l| l.number == *lane);
    if document.lanes.is_empty() || !document.lanes.iter().all(known) {
        return Err(format!("lanes must be some of the scene's, are {:?}", document.lanes));
    }
    if document.vehicle_seeds == 0 || document.scenes_per_class == 0 {
        return Err("vehicle_seeds and scenes_per_class must be at least 1".into());
    }
    if document.scenes_per_class > SCENES_LIMIT {
        return Err(format!("scenes_per_class must be at most {SCENES_LIMIT}, is {}", document.scenes_per_class));
    }
    check_models(document)
}

fn check_models(document: &Document) -> Result<(), String> {
    for (class, models) in &document.models {
        if models.is_empty() {
            return Err(format!("models.{}: name at least one", class.name()));
        }
        for model in models {
            match scene::vehicles::class_of(model) {
                Some(own) if own == *class => {}
                Some(own) => return Err(format!("models.{}: `{model}` is a {}", class.name(), own.name())),
                None => {
                    return Err(format!(
                        "models.{}: `{model}` is none of {:?}",
                        class.name(),
                        scene::vehicles::names()
                    ));
                }
            }
        }
    }
    Ok(())
}
