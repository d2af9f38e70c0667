//! Marks of waves between two bodies on traced streets, through the whole chain.

use crate::project::this_program;
use crate::study::extent::Extent;
use crate::study::pages::measures::signals::ghost_streets::{Counts, SCENE, counts};
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{CHAIN, SourcePaths};
use std::path::Path;
use std::process::Command;
use wayside::host::failure::Failure;
use wayside::host::progress::note;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[CHAIN, &["crates/wayside/tests/scenes/ghost_streets.rs", file!()]];

/// Transmitters in two rows.
const TWO_ROWS: &str = "tx_half_wavelengths = [[0, 0], [4, 0], [8, 0], [0, 2], [4, 2], [8, 2]]\n\
                        rx_half_wavelengths = [[0, 0], [1, 0], [2, 0], [3, 0], [0, 1], [1, 1], [2, 1], [3, 1]]";

/// Name, keys of the array, least distance of the pair in direction cosines, streets.
const ARRAYS: [(&str, &str, f64, u64); 4] = [
    ("3 × 4", "preset = \"3x4\"", 1.0 / 6.0, 20),
    ("6 × 8", "preset = \"6x8\"", 1.0 / 6.0, 20),
    ("6 × 8, both in two rows", TWO_ROWS, 1.0 / 6.0, 20),
    ("12 × 16", "preset = \"12x16\"", 2.0 / 192.0, 3),
];

pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    part.head(&["array", "waves over two bodies, marked", "echoes of one body, marked"]);
    for (name, array, beam, streets) in ARRAYS {
        let streets = extent.case_count(streets);
        let Counts { ghosts, direct, wrong } = counts(array, beam, 0..streets as u32, &table_of)?;
        wrong.iter().for_each(note);
        part.line(format!(
            "| {name} ({streets} streets) | {} of {} | {} of {} |",
            ghosts.marked, ghosts.all, direct.marked, direct.all
        ));
    }
    Ok(part)
}

/// The table of points of a street, made by this program in a separate folder.
fn table_of(files: &[(String, String)]) -> Result<String, Failure> {
    let folder = tempfile::tempdir().map_err(|e| Failure::System(format!("a folder for a street: {e}")))?;
    let place = folder.path();
    for (name, text) in files {
        std::fs::write(place.join(name), text).map_err(|e| Failure::system(&place.join(name), "write", e))?;
    }
    run(place, &["run", SCENE, "--out", "out", "--quiet", "--no-cache"])?;
    run(place, &["export", "out/frames.points", "--to", "csv", "--out", "table.csv"])?;
    let table = place.join("table.csv");
    std::fs::read_to_string(&table).map_err(|e| Failure::system(&table, "read", e))
}

fn run(folder: &Path, words: &[&str]) -> Result<(), Failure> {
    let refused = |e: &dyn std::fmt::Display| Failure::Refused(format!("`{}`: {e}", words.join(" ")));
    let program = this_program()?;
    let output = Command::new(program).args(words).current_dir(folder).output().map_err(|e| refused(&e))?;
    let said = String::from_utf8_lossy(&output.stderr);
    if output.status.success() { Ok(()) } else { Err(refused(&said)) }
}
