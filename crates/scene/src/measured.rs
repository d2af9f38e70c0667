//! Measurements of a radar, from files: its pattern, and the errors of its channels.

mod table_text;
pub(crate) mod pattern_table;
pub(crate) mod calibration;
