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

use toml::de::DeValue;

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

/// Tables of a file of materials.
pub(crate) const MATERIAL_FILE_TABLES: &[Table] =
    &[scene::MATERIAL_FILE, materials::MATERIAL, materials::LAYER];

/// Headings of the tables, other than `here`, that know `key`, the likeliest first: `[[target]]`, and outer
/// tables before inner ones. If some of them take values of the type of `value`, the others are left out.
pub(crate) fn tables_with_key(
    tables: &'static [Table],
    (key, value): (&str, &DeValue<'_>),
    here: &Table,
) -> Vec<&'static str> {
    let mut homes: Vec<&Table> =
        tables.iter().filter(|table| table.name != here.name && table.has(key)).collect();
    if homes.iter().any(|table| table.takes(key, value)) {
        homes.retain(|table| table.takes(key, value));
    }
    homes.sort_by_key(|table| (table.name != bodies::TARGET.name, table.name.matches('.').count()));
    homes.into_iter().map(|table| table.heading).collect()
}
