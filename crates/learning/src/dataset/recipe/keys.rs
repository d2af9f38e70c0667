//! Every key of a recipe and of a manifest of vehicles, declared once as those of scenes are: name with unit,
//! type, range, default and sentence; `docs/datasets.md` has them at length.

use artifact::seed::SEEDS;
use artifact::settings::Class;
use scene::AllowedRange::{self, Above, Between};
use scene::document::keys::key::{DefaultValue, Key, Table};
use scene::document::keys::kinds::{
    Boolean, Choice, Integer, IntegerVector, Integers, Number, Subtables, Text, Texts, Vector,
};

/// Scenes of a class: at a second a scene a week and a half.
const SCENES_LIMIT: u32 = 1_000_000;
/// Vehicles of a scene: more than stand within reach of a radar in three lanes.
pub(in crate::dataset) const VEHICLES_LIMIT: u32 = 16;
/// Frames of a scene: a minute and a half at ten a second.
pub(in crate::dataset) const FRAMES_LIMIT: u32 = 1000;

/// Each table of a recipe.
pub(super) const TABLES: &[Table] = &[RECIPE, MODELS];

pub(super) const RECIPE: Table = Table {
    name: "",
    heading: "the beginning of the file",
    about: "Scenes of vehicles before the radars of some scenes, as they are drawn.",
    keys: &[
        &SCENE,
        &SCENES,
        &SEED,
        &SCENES_PER_CLASS,
        &SCENES_PER_SHARD,
        &RANGE,
        &SPEED,
        &LANES,
        &VEHICLE_SEEDS,
        &YAW,
        &OFFSET,
        &RADAR_HEIGHT,
        &TILT,
        &EXTRA_NOISE,
        &FRAMES,
        &FRAME_INTERVAL,
        &VEHICLES_PER_SCENE,
        &QUEUE_SHARE,
        &STATISTICAL_SHARE,
        &CROPS,
        &MODELS_KEY,
    ],
};

pub(super) const SCENE: Key<Text> = Key::new("scene", Text("a file"), "whose radar all scenes have");

pub(super) const SCENES: Key<Texts> = Key::new(
    "scenes",
    Texts("a file or a list of files"),
    "whose radars are drawn evenly, in place of `scene`",
);

pub(super) const SEED: Key<Integer> =
    Key::new("seed", Integer(Between(0.0, *SEEDS.end() as f64)), "of every draw").required();

pub(super) const SCENES_PER_CLASS: Key<Integer> =
    Key::new("scenes_per_class", Integer(Between(1.0, SCENES_LIMIT as f64)), "drawn for each class")
        .required();

pub(super) const SCENES_PER_SHARD: Key<Integer, DefaultValue<u64>> = Key::new(
    "scenes_per_shard",
    Integer(Between(1.0, u32::MAX as f64)),
    "what an interruption costs at most",
)
.with_default(64);

/// Distances up to those of a scene's targets.
pub(super) const RANGE: Key<Vector<2>> =
    Key::new("range_m", Vector(Above(0.0, 1e5)), "m: least and greatest slant range").required();

/// Speeds up to those of a scene's targets.
pub(super) const SPEED: Key<Vector<2>> =
    Key::new("speed_mps", Vector(Between(0.0, 340.0)), "m/s: least and greatest speed").required();

/// Lanes are numbered as far as a byte goes.
const LANES_OF_ONE: AllowedRange = Between(1.0, 255.0);

pub(super) const LANES: Key<Integers> =
    Key::new("lanes", Integers { length: LANES_OF_ONE, each: Between(0.0, 255.0) }, "drawn evenly")
        .required();

/// Variants are seeds too.
pub(super) const VEHICLE_SEEDS: Key<Integer, DefaultValue<u64>> = Key::new(
    "vehicle_seeds",
    Integer(Between(1.0, *SEEDS.end() as f64)),
    "number of variants of the project's own vehicles",
)
.with_default(1);

pub(super) const YAW: Key<Vector<2>, DefaultValue<[f64; 2]>> =
    Key::new("yaw_deg", Vector(Between(-180.0, 180.0)), "degrees off the lane's direction")
        .with_default([0.0; 2]);

pub(super) const OFFSET: Key<Vector<2>, DefaultValue<[f64; 2]>> =
    Key::new("offset_m", Vector(Between(-100.0, 100.0)), "m off the lane's middle").with_default([0.0; 2]);

pub(super) const RADAR_HEIGHT: Key<Vector<2>> =
    Key::new("radar_height_m", Vector(Above(0.0, 1e3)), "m: least and greatest height of the radar");

pub(super) const TILT: Key<Vector<2>> =
    Key::new("tilt_deg", Vector(Between(-90.0, 90.0)), "degrees: elevation of the boresight");

pub(super) const EXTRA_NOISE: Key<Vector<2>, DefaultValue<[f64; 2]>> =
    Key::new("extra_noise_db", Vector(Between(-100.0, 100.0)), "dB more noise than the base scene's")
        .with_default([0.0; 2]);

pub(super) const FRAMES: Key<Integer, DefaultValue<u64>> =
    Key::new("frames", Integer(Between(1.0, FRAMES_LIMIT as f64)), "of a scene").with_default(1);

pub(super) const FRAME_INTERVAL: Key<Number> =
    Key::new("frame_interval_s", Number(Above(0.0, 1e4)), "s, no less than a frame of the radar lasts");

pub(super) const VEHICLES_PER_SCENE: Key<IntegerVector<2>, DefaultValue<[u64; 2]>> = Key::new(
    "vehicles_per_scene",
    IntegerVector(Between(1.0, VEHICLES_LIMIT as f64)),
    "least and greatest number",
)
.with_default([1; 2]);

pub(super) const QUEUE_SHARE: Key<Number, DefaultValue<f64>> =
    Key::new("queue_share", Number(Between(0.0, 1.0)), "share of the scenes in which all queue")
        .with_default(0.0);

pub(super) const STATISTICAL_SHARE: Key<Number, DefaultValue<f64>> = Key::new(
    "statistical_share",
    Number(Between(0.0, 1.0)),
    "of the scenes whose small parts are drawn, as `[model] detail = \"statistical\"` does",
)
.with_default(0.0);

pub(super) const CROPS: Key<Boolean, DefaultValue<bool>> =
    Key::new("crops", Boolean, "whether crops are kept beside signatures").with_default(true);

pub(super) const MODELS_KEY: Key<Subtables> =
    Key::new("models", Subtables::one(&MODELS), "bodies of each class").required();

pub(super) const MODELS: Table = Table {
    name: "models",
    heading: "[models]",
    about: "Bodies that are drawn, for each class.",
    keys: &[&VEHICLES, &CAR, &BUS, &TRUCK, &MOTORCYCLE],
};

pub(super) const VEHICLES: Key<Text> =
    Key::new("vehicles", Text("a folder"), "with a manifest that tells names and classes");

const WORDS: Texts = Texts("names of own vehicles, mesh files, folders, `own` or `crosses`");

pub(super) const CAR: Key<Texts> = Key::new("car", WORDS, "cars");

pub(super) const BUS: Key<Texts> = Key::new("bus", WORDS, "buses");

pub(super) const TRUCK: Key<Texts> = Key::new("truck", WORDS, "trucks");

pub(super) const MOTORCYCLE: Key<Texts> = Key::new("motorcycle", WORDS, "motorcycles");

/// Each table of a manifest of vehicles.
pub(super) const MANIFEST_TABLES: &[Table] = &[MANIFEST, LISTED];

pub(super) const MANIFEST: Table = Table {
    name: "",
    heading: "the beginning of the file",
    about: "Vehicles of a folder.",
    keys: &[&VEHICLE_KEY],
};

pub(super) const VEHICLE_KEY: Key<Subtables> =
    Key::new("vehicle", Subtables::several(&LISTED), "each of the vehicles").required();

pub(super) const LISTED: Table = Table {
    name: "vehicle",
    heading: "[[vehicle]]",
    about: "A vehicle of the folder.",
    keys: &[&LISTED_NAME, &LISTED_CLASS],
};

pub(super) const LISTED_NAME: Key<Text> =
    Key::new("name", Text("a name"), "of its `.glb` without the ending").required();

pub(super) const LISTED_CLASS: Key<Choice<Class>> =
    Key::new("class", Choice::CLASSES, "truth for the classifier").required();

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_of_a_recipe_and_of_a_manifest_is_on_their_page() {
        let page = include_str!("../../../../../docs/datasets.md");
        for key in [TABLES, MANIFEST_TABLES].concat().iter().flat_map(Table::names) {
            let is_told = [format!("`{key}`"), format!("[{key}]"), format!("`{key} =")];
            assert!(is_told.iter().any(|form| page.contains(form)), "docs/datasets.md does not tell `{key}`");
        }
    }
}
