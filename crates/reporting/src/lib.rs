//! Pictures of frames, drawn once as SVG and written as PNG, and `report.html`: one self-contained file with
//! its numbers, drawings and views to walk around in.
//!
//! In go frames and summaries of `pipeline`; nothing is computed here that a result depends on.
//!
//! Reading order is that of the rooms below; each uses only those that stand before it.

pub mod pictures; // scenes, maps, profiles and points, as SVG, PNG and EXR
pub mod report; // pages of a run, of several radars, of a study, of a table
