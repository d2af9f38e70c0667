//! Content of a recipe's file; its keys are in `docs/datasets.md`.

use crate::dataset::models::Choice;
use artifact::scene::SceneHeader;
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// Content of a recipe's file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Document {
    pub(super) scene: Option<PathBuf>,
    #[serde(default)]
    pub(super) scenes: Vec<PathBuf>,
    pub(super) seed: u64,
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
    pub(super) models: Choice,
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
    /// Name of the scene's file.
    pub(super) name: String,
    pub(super) header: SceneHeader,
}

impl Document {
    /// One by `scene`, several by `scenes`.
    pub(super) fn base_scenes(&self) -> Result<Vec<&Path>, String> {
        match (&self.scene, self.scenes.as_slice()) {
            (Some(scene), []) => Ok(vec![scene]),
            (None, []) => Err("scene or scenes: name the base scene, or several".into()),
            (None, several) => Ok(several.iter().map(PathBuf::as_path).collect()),
            (Some(_), _) => Err("scene and scenes: give one of the two keys, not both".into()),
        }
    }
}
