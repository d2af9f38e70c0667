//! `report.html`: one self-contained file that opens from disk.

mod page;
mod tables;

use crate::failure::Failure;
use crate::output;
use crate::pictures::FrameFigures;
use serde_json::Value;
use std::path::Path;

/// Frames that get pictures of their own in the report; the others stand in its tables.
pub(crate) const FRAMES_DRAWN: usize = 4;

/// Writes the report of a run from its summary and its figures.
pub(crate) fn write(summary: &Value, figures: &[FrameFigures], out: &Path) -> Result<(), Failure> {
    output::write_file(&out.join("report.html"), page::page(summary, figures).as_bytes())
}
