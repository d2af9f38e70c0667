//! `report.html`: one self-contained file that opens from disk.

pub mod figures;
pub(crate) mod provenance_paragraph;
mod accuracy;
mod echo_errors;
mod false_objects;
mod page;
mod plan;
mod radars;
pub mod rcs_view;
pub mod sweep_view;
mod tables;
mod tracks;
pub(crate) mod viewer;

use crate::report::figures::Figures;
pub use page::{figure, is_report, sheet};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::outcome::summary::{RadarsSummary, Summary};
use plotting::layout::Figure;
pub use provenance_paragraph::ReportOrigin;
use std::path::Path;
pub use tables::scrolled;

/// Number of frames with pictures in the report; the others are only in its tables.
pub const FRAMES_DRAWN: usize = 4;

/// Largest number of pictures in a strip.
const STRIP: u32 = 12;

/// Whether a frame is in the strip of a long scene: every n-th, if not all are drawn.
pub fn is_in_strip(index: u32, frames: u32) -> bool {
    frames as usize > FRAMES_DRAWN && index.is_multiple_of(frames.div_ceil(STRIP))
}

/// Writes the report of a run from its summary and its figures.
pub fn write(summary: &Summary, figures: &Figures, origin: &ReportOrigin, out: &Path) -> Result<(), Failure> {
    files::write_file(&out.join("report.html"), page::page(summary, figures, origin).as_bytes())
}

/// Writes the report of several radars, each with its id and summary, above theirs.
pub fn write_several(
    summary: &RadarsSummary,
    radars: &[(&str, &Summary)],
    views: &[Figure],
    origin: &ReportOrigin,
    out: &Path,
) -> Result<(), Failure> {
    files::write_file(&out.join("report.html"), radars::page(summary, radars, views, origin).as_bytes())
}
