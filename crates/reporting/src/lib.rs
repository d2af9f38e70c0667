//! Pictures of frames, drawn once as SVG and written as PNG, the lines that a run prints at its end, and
//! `report.html`: one self-contained file with its numbers, drawings and interactive views.
//!
//! The inputs are frames and summaries of `pipeline`; no result depends on anything computed here.
//!
//! Read the rooms below in their order; each uses only those before it.

pub mod pictures; // scenes, maps, profiles and points, as SVG, PNG and EXR
pub mod console_lines; // the lines that a run prints at its end
pub mod report; // pages of a run, of several radars, of a study, of a table
