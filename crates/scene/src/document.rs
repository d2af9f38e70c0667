//! A scene file as tables with positions: its keys, its faults, and its values by type.

pub(crate) mod ranges;
pub mod keys;
pub(crate) mod synonyms;
pub(crate) mod errors;
pub mod diagnostics;
pub(crate) mod changes;
pub mod section;
pub mod values;
pub(crate) mod entries;
pub(crate) mod text;
pub mod toml_text;
pub(crate) mod ids;
