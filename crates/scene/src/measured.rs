//! Measurements of a radar, from files: its pattern, and how its channels differ.

mod table_text;
pub(crate) mod pattern_table;
pub(crate) mod calibration;
