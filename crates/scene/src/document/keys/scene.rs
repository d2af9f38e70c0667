//! Top-level keys of a scene file and of a file of materials.

use crate::document::keys::bodies::{CLUTTER, TARGET};
use crate::document::keys::fidelity::FIDELITY;
use crate::document::keys::key::{Key, Or, Table};
use crate::document::keys::kinds::{Below, Name, Number, TableForm, Whole};
use crate::document::keys::lanes::INTERSECTION;
use crate::document::keys::materials::{MATERIAL, ROAD};
use crate::document::keys::processing::{DSP, NOISE};
use crate::document::keys::radar::{RADAR, RADARS};
use crate::document::keys::traffic::TRAFFIC;
use crate::document::ranges::SEEDS;
use crate::wording::allowed::Allowed::{Above, Between};

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
        &OF_RADAR,
        &OF_RADARS,
        &OF_NOISE,
        &OF_DSP,
        &OF_FIDELITY,
        &OF_MATERIALS,
        &OF_INTERSECTION,
        &OF_ROAD,
        &OF_TARGETS,
        &OF_CLUTTER,
        &OF_TRAFFIC,
    ],
};

pub(crate) const NAME: Key<Name> = Key::new("name", Name, "names the results, their folder too").required();

pub(crate) const SEED: Key<Whole, Or<u64>> =
    Key::new("seed", Whole(SEEDS), "of noise and everything random").or(1);

pub(crate) const FRAMES: Key<Whole, Or<u64>> = Key::new(
    "frames",
    Whole(Between(1.0, 1e6)),
    "radar frames; with [traffic] by default as many as the recording has",
)
.or(1);

pub(crate) const FRAME_INTERVAL: Key<Number, Or<f64>> = Key::new(
    "frame_interval_s",
    Number(Above(0.0, 1e4)),
    "s from one frame's first sample to the next's; with several frames, and with [traffic] without \
     `frames`, not shorter than a frame with all its sub-frames",
)
.or(0.1);

pub(crate) const OF_RADAR: Key<Below> = Key::new("radar", Below::one(&RADAR), THE_TABLES_BELOW);

pub(crate) const OF_RADARS: Key<Below> = Key::new("radars", Below::several(&RADARS), THE_TABLES_BELOW);

pub(crate) const OF_NOISE: Key<Below> = Key::new("noise", Below::one(&NOISE), THE_TABLES_BELOW);

pub(crate) const OF_DSP: Key<Below> = Key::new("dsp", Below::one(&DSP), THE_TABLES_BELOW);

pub(crate) const OF_FIDELITY: Key<Below> = Key::new("fidelity", Below::one(&FIDELITY), THE_TABLES_BELOW);

pub(crate) const OF_MATERIALS: Key<Below> =
    Key::new("materials", Below { form: TableForm::Named, table: &MATERIAL }, THE_TABLES_BELOW);

pub(crate) const OF_INTERSECTION: Key<Below> =
    Key::new("intersection", Below::one(&INTERSECTION), THE_TABLES_BELOW);

pub(crate) const OF_ROAD: Key<Below> = Key::new("road", Below::one(&ROAD), THE_TABLES_BELOW);

pub(crate) const OF_TARGETS: Key<Below> = Key::new("target", Below::several(&TARGET), THE_TABLES_BELOW);

pub(crate) const OF_CLUTTER: Key<Below> = Key::new("clutter", Below::several(&CLUTTER), THE_TABLES_BELOW);

pub(crate) const OF_TRAFFIC: Key<Below> = Key::new("traffic", Below::one(&TRAFFIC), THE_TABLES_BELOW);

/// A file of materials.
pub(crate) const MATERIAL_FILE: Table = Table {
    name: "",
    heading: "the beginning of the file",
    about: "Names of materials, and what they stand for.",
    keys: &[&OF_MATERIALS],
};
