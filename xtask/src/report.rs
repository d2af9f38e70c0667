//! `report.html`: one self-contained file that opens from disk.

mod made;
mod accuracy;
mod false_objects;
mod page;
mod radars;
mod tables;
mod tracks;

use crate::failure::Failure;
use crate::output;
use crate::pictures::Figure;
use crate::products::Figures;
use serde_json::Value;
use std::path::Path;

/// Frames that get pictures of their own in the report; the others stand in its tables.
pub(crate) const FRAMES_DRAWN: usize = 4;

/// Pictures of a strip, at most.
const STRIP: u32 = 12;

/// Whether a frame is one of those that show how a long scene goes on: every n-th, where not all are drawn.
pub(crate) fn is_in_strip(index: u32, frames: u32) -> bool {
    frames as usize > FRAMES_DRAWN && index.is_multiple_of(frames.div_ceil(STRIP))
}

/// Writes the report of a run from its summary and its figures.
pub(crate) fn write(summary: &Value, figures: &Figures, out: &Path) -> Result<(), Failure> {
    output::write_file(&out.join("report.html"), page::page(summary, figures, out).as_bytes())
}

/// Writes the report of several radars over theirs.
pub(crate) fn write_several(summary: &Value, views: &[Figure], out: &Path) -> Result<(), Failure> {
    output::write_file(&out.join("report.html"), radars::page(summary, views, out).as_bytes())
}
