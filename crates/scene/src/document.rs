//! A scene file as tables with positions: its keys, its faults, and its values by type.

pub(crate) mod ranges;
pub mod keys;
pub(crate) mod synonyms;
pub(crate) mod errors;
pub(crate) mod faults;
pub(crate) mod changes;
pub(crate) mod section;
pub(crate) mod values;
pub(crate) mod entries;
pub(crate) mod text;
pub mod toml_text;
pub(crate) mod ids;
