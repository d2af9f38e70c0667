//! Content of a recipe's file; its keys are in `docs/datasets.md`.

use crate::dataset::recipe::keys;
use crate::dataset::recipe::models::ModelChoice;
use artifact::scene::SceneHeader;
use scene::document::diagnostics::Diagnostics;
use scene::document::section::Section;
use std::path::{Path, PathBuf};

/// Content of a recipe's file. Of one that is refused it has what stands for values that are not there.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::dataset) struct Document {
    /// Base scenes, one by `scene` or several by `scenes`.
    pub(in crate::dataset) scenes: Vec<PathBuf>,
    pub(in crate::dataset) seed: u64,
    pub(in crate::dataset) scenes_per_class: u32,
    pub(in crate::dataset) scenes_per_shard: u32,
    pub(in crate::dataset) range_m: [f64; 2],
    pub(in crate::dataset) speed_mps: [f64; 2],
    pub(in crate::dataset) lanes: Vec<u8>,
    pub(in crate::dataset) vehicle_seeds: u64,
    pub(in crate::dataset) yaw_deg: [f64; 2],
    pub(in crate::dataset) offset_m: [f64; 2],
    pub(in crate::dataset) radar_height_m: Option<[f64; 2]>,
    pub(in crate::dataset) tilt_deg: Option<[f64; 2]>,
    pub(in crate::dataset) extra_noise_db: [f64; 2],
    pub(in crate::dataset) frames: u32,
    pub(in crate::dataset) frame_interval_s: Option<f64>,
    pub(in crate::dataset) vehicles_per_scene: [u32; 2],
    pub(in crate::dataset) queue_share: f64,
    pub(in crate::dataset) statistical_share: f64,
    pub(in crate::dataset) crops: bool,
    pub(super) models: ModelChoice,
}

/// A scene of which radar, noise, processing and fidelity are taken; its own targets are not used.
pub(in crate::dataset) struct Base {
    /// Name of the scene's file.
    pub(in crate::dataset) name: String,
    pub(in crate::dataset) header: SceneHeader,
}

impl Document {
    /// The recipe's content; missing and unknown keys, wrong types and numbers out of range are noted.
    pub(super) fn of(root: &Section<'_>, models: &Section<'_>) -> Self {
        let needed = keys::RECIPE.keys.iter().filter(|key| key.is_required());
        needed.for_each(|key| root.require(key.name()));
        // The range of each key is within the type.
        let counts = |count: u64| u32::try_from(count).unwrap_or(u32::MAX);
        Self {
            scenes: scenes(root),
            seed: root.read(&keys::SEED).unwrap_or(0),
            scenes_per_class: root.read(&keys::SCENES_PER_CLASS).map_or(1, counts),
            scenes_per_shard: counts(root.or_default(&keys::SCENES_PER_SHARD)),
            // Beyond all that it is compared with.
            range_m: root.read(&keys::RANGE).unwrap_or([f64::INFINITY; 2]),
            speed_mps: root.read(&keys::SPEED).unwrap_or([0.0; 2]),
            lanes: root.read(&keys::LANES).unwrap_or_default().into_iter().filter_map(lane).collect(),
            vehicle_seeds: root.or_default(&keys::VEHICLE_SEEDS),
            yaw_deg: root.or_default(&keys::YAW),
            offset_m: root.or_default(&keys::OFFSET),
            radar_height_m: root.read(&keys::RADAR_HEIGHT),
            tilt_deg: root.read(&keys::TILT),
            extra_noise_db: root.or_default(&keys::EXTRA_NOISE),
            frames: counts(root.or_default(&keys::FRAMES)),
            frame_interval_s: root.read(&keys::FRAME_INTERVAL),
            vehicles_per_scene: root.or_default(&keys::VEHICLES_PER_SCENE).map(counts),
            queue_share: root.or_default(&keys::QUEUE_SHARE),
            statistical_share: root.or_default(&keys::STATISTICAL_SHARE),
            crops: root.or_default(&keys::CROPS),
            models: ModelChoice::of(models),
        }
    }

    /// The content of another recipe's text; `None` if it breaks a rule.
    pub(super) fn of_text(text: &str) -> Option<Self> {
        let faults = Diagnostics::of_tables(Path::new(""), text, keys::TABLES);
        let document = faults.document();
        let root = Section::root(&document, &keys::RECIPE, &faults);
        let said = Self::of(&root, &root.section(&keys::MODELS));
        drop(root);
        faults.into_errors().ok().map(|()| said)
    }
}

fn scenes(root: &Section<'_>) -> Vec<PathBuf> {
    let one = root.read(&keys::SCENE).map(PathBuf::from);
    let several = root.read(&keys::SCENES).unwrap_or_default();
    one.into_iter().chain(several.into_iter().map(PathBuf::from)).collect()
}

/// Number of a lane; the range of the key is a byte's.
fn lane(number: u64) -> Option<u8> {
    u8::try_from(number).ok()
}
