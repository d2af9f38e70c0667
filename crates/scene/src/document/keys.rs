//! Every key of a scene, declared once: name with unit, type, range, default and sentence. The reader's
//! checks, the suggestions in errors, the tables of `docs/scenes.md` ([`with_tables`]) and the schema for
//! editors ([`json_schema`]) are all derived from it.

pub mod key;
pub mod kinds;
pub(crate) mod waveform;
pub(crate) mod array;
pub(crate) mod receiver;
pub(crate) mod lanes;
pub(crate) mod radar;
pub(crate) mod processing;
pub(crate) mod fidelity;
pub(crate) mod materials;
pub(crate) mod bodies;
pub(crate) mod traffic;
pub(crate) mod scene;
mod page;
mod schema;

pub use key::Table;
pub use page::{mark, markdown, with_tables};
pub use schema::json_schema;

/// All tables, in the order of `docs/scenes.md`.
pub const TABLES: &[Table] = &[
    scene::SCENE,
    radar::RADAR,
    waveform::WAVEFORM,
    array::ARRAY,
    radar::LINK,
    receiver::RECEIVER,
    receiver::INTERFERER,
    lanes::RADAR_INTERSECTION,
    radar::RADARS,
    processing::NOISE,
    processing::DSP,
    fidelity::FIDELITY,
    fidelity::MODEL,
    materials::MATERIAL,
    materials::LAYER,
    lanes::INTERSECTION,
    materials::ROAD,
    bodies::TARGET,
    bodies::CLUTTER,
    traffic::TRAFFIC,
    traffic::MODEL_OF_TYPE,
];

/// The heading of one of these tables, other than `here`, that knows `key`.
pub(crate) fn table_with_key(tables: &'static [Table], key: &str, here: &Table) -> Option<&'static str> {
    tables.iter().find(|table| table.name != here.name && table.has(key)).map(|table| table.heading)
}
