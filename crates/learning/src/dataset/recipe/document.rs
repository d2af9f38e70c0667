//! Content of a recipe's file; its keys are in `docs/datasets.md`.

use crate::dataset::recipe::error::RecipeError;
use crate::dataset::recipe::models::Choice;
use artifact::scene::SceneHeader;
use serde::de::Error;
use serde::{Deserialize, Deserializer};
use std::path::{Path, PathBuf};

/// Content of a recipe's file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::dataset) struct Document {
    pub(in crate::dataset) scene: Option<PathBuf>,
    #[serde(default)]
    pub(in crate::dataset) scenes: Vec<PathBuf>,
    pub(in crate::dataset) seed: u64,
    pub(in crate::dataset) scenes_per_class: u32,
    #[serde(default = "some")]
    pub(in crate::dataset) scenes_per_shard: u32,
    #[serde(deserialize_with = "pair")]
    pub(in crate::dataset) range_m: [f64; 2],
    #[serde(deserialize_with = "pair")]
    pub(in crate::dataset) speed_mps: [f64; 2],
    pub(in crate::dataset) lanes: Vec<u8>,
    #[serde(default = "one")]
    pub(in crate::dataset) vehicle_seeds: u64,
    #[serde(default, deserialize_with = "pair")]
    pub(in crate::dataset) yaw_deg: [f64; 2],
    #[serde(default, deserialize_with = "pair")]
    pub(in crate::dataset) offset_m: [f64; 2],
    #[serde(default, deserialize_with = "known_pair")]
    pub(in crate::dataset) radar_height_m: Option<[f64; 2]>,
    #[serde(default, deserialize_with = "known_pair")]
    pub(in crate::dataset) tilt_deg: Option<[f64; 2]>,
    #[serde(default, deserialize_with = "pair")]
    pub(in crate::dataset) extra_noise_db: [f64; 2],
    #[serde(default = "one")]
    pub(in crate::dataset) frames: u32,
    pub(in crate::dataset) frame_interval_s: Option<f64>,
    #[serde(default = "alone", deserialize_with = "pair")]
    pub(in crate::dataset) vehicles_per_scene: [u32; 2],
    #[serde(default)]
    pub(in crate::dataset) queue_share: f64,
    #[serde(default = "kept")]
    pub(in crate::dataset) crops: bool,
    pub(super) models: Choice,
}

/// Two values and no more: a third one of a list would be passed over.
fn pair<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<[T; 2], D::Error> {
    let values = Vec::<T>::deserialize(from)?;
    let found = values.len();
    values.try_into().map_err(|_| Error::invalid_length(found, &"[least, greatest]"))
}

fn known_pair<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[f64; 2]>, D::Error> {
    pair(from).map(Some)
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
pub(in crate::dataset) struct Base {
    /// Name of the scene's file.
    pub(in crate::dataset) name: String,
    pub(in crate::dataset) header: SceneHeader,
}

impl Document {
    /// One by `scene`, several by `scenes`.
    pub(super) fn base_scenes(&self) -> Result<Vec<&Path>, RecipeError> {
        match (&self.scene, self.scenes.as_slice()) {
            (Some(scene), []) => Ok(vec![scene]),
            (None, []) => Err(RecipeError::NoBaseScene),
            (None, several) => Ok(several.iter().map(PathBuf::as_path).collect()),
            (Some(_), _) => Err(RecipeError::BaseScenesTwice),
        }
    }

    /// Refusal of a base scene that has several radars.
    pub(super) fn of_several_radars(&self, scene: &Path, radars: Vec<String>) -> RecipeError {
        let key = if self.scene.is_some() { "scene" } else { "scenes" };
        RecipeError::SeveralRadars { key, scene: scene.display().to_string(), radars }
    }
}
