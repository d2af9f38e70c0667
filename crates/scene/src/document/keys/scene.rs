//! Top-level keys of a scene file and of a file of materials.

use crate::document::keys::bodies::{CLUTTER, TARGET};
use crate::document::keys::fidelity::{FIDELITY, MODEL};
use crate::document::keys::key::{DefaultValue, Key, Table};
use crate::document::keys::kinds::{Integer, Name, Number, Subtables, TableForm};
use crate::document::keys::lanes::INTERSECTION;
use crate::document::keys::materials::{MATERIAL, ROAD};
use crate::document::keys::processing::{DSP, NOISE};
use crate::document::keys::radar::{RADAR, RADARS};
use crate::document::keys::traffic::TRAFFIC;
use crate::document::ranges::SEEDS;
use crate::wording::allowed_range::AllowedRange::{Above, Between};

const THE_TABLES_BELOW: &str = "the tables below";

pub(crate) const SCENE: Table = Table {
    name: "",
    heading: "the beginning of the file",
    about: "What the radar is, what stands on the road, and how the result is to be computed.",
    keys: &[
        &NAME,
        &SEED,
        &FRAMES,
        &FRAME_INTERVAL,
        &RADAR_KEY,
        &RADARS_KEY,
        &NOISE_KEY,
        &DSP_KEY,
        &FIDELITY_KEY,
        &MODEL_KEY,
        &MATERIALS_KEY,
        &INTERSECTION_KEY,
        &ROAD_KEY,
        &TARGETS_KEY,
        &CLUTTER_KEY,
        &TRAFFIC_KEY,
    ],
};

pub(crate) const NAME: Key<Name> = Key::new("name", Name, "names the results, their folder too").required();

pub(crate) const SEED: Key<Integer, DefaultValue<u64>> =
    Key::new("seed", Integer(SEEDS), "of noise and everything random").with_default(1);

pub(crate) const FRAMES: Key<Integer, DefaultValue<u64>> = Key::new(
    "frames",
    Integer(Between(1.0, 1e6)),
    "radar frames; with [traffic] by default as many as the recording has",
)
.with_default(1);

pub(crate) const FRAME_INTERVAL: Key<Number, DefaultValue<f64>> = Key::new(
    "frame_interval_s",
    Number(Above(0.0, 1e4)),
    "s from one frame's first sample to the next's; with several frames, and with [traffic] without \
     `frames`, not shorter than a frame with all its sub-frames",
)
.with_default(0.1);

pub(crate) const RADAR_KEY: Key<Subtables> = Key::new("radar", Subtables::one(&RADAR), THE_TABLES_BELOW);

pub(crate) const RADARS_KEY: Key<Subtables> =
    Key::new("radars", Subtables::several(&RADARS), THE_TABLES_BELOW);

pub(crate) const NOISE_KEY: Key<Subtables> = Key::new("noise", Subtables::one(&NOISE), THE_TABLES_BELOW);

pub(crate) const DSP_KEY: Key<Subtables> = Key::new("dsp", Subtables::one(&DSP), THE_TABLES_BELOW);

pub(crate) const FIDELITY_KEY: Key<Subtables> =
    Key::new("fidelity", Subtables::one(&FIDELITY), THE_TABLES_BELOW);

pub(crate) const MODEL_KEY: Key<Subtables> = Key::new("model", Subtables::one(&MODEL), THE_TABLES_BELOW);

pub(crate) const MATERIALS_KEY: Key<Subtables> =
    Key::new("materials", Subtables { form: TableForm::Named, table: &MATERIAL }, THE_TABLES_BELOW);

pub(crate) const INTERSECTION_KEY: Key<Subtables> =
    Key::new("intersection", Subtables::one(&INTERSECTION), THE_TABLES_BELOW);

pub(crate) const ROAD_KEY: Key<Subtables> = Key::new("road", Subtables::one(&ROAD), THE_TABLES_BELOW);

pub(crate) const TARGETS_KEY: Key<Subtables> =
    Key::new("target", Subtables::several(&TARGET), THE_TABLES_BELOW);

pub(crate) const CLUTTER_KEY: Key<Subtables> =
    Key::new("clutter", Subtables::several(&CLUTTER), THE_TABLES_BELOW);

pub(crate) const TRAFFIC_KEY: Key<Subtables> =
    Key::new("traffic", Subtables::one(&TRAFFIC), THE_TABLES_BELOW);

/// A file of materials.
pub(crate) const MATERIAL_FILE: Table = Table {
    name: "",
    heading: "the beginning of the file",
    about: "Names of materials, and what they stand for.",
    keys: &[&MATERIALS_KEY],
};
