//! Pictures of frames, drawn once as SVG and written as PNG, and `report.html`: one self-contained file with
//! its numbers, drawings and interactive views.
//!
//! The inputs are frames and summaries of `pipeline`; no result depends on anything computed here.
//!
//! Read the rooms below in their order; each uses only those before it.

pub mod pictures; // scenes, maps, profiles and points, as SVG, PNG and EXR
pub mod report; // pages of a run, of several radars, of a study, of a table
