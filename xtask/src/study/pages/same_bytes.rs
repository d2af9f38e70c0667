//! The same work with other numbers of threads, by an unoptimized program and on an older processor: which
//! files are equal to the byte, and the difference of the others.

mod differences; // values of two results, compared
mod variants; // programs and their command lines

use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{CHAIN, SourcePaths};
use differences::{Differences, identical};
use std::path::Path;
use variants::Variant;
use wayside::host::failure::Failure;
use wayside::host::progress::Work;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths =
    &[CHAIN, &["crates/po-sbr", "xtask/src/study/pages/same_bytes", "xtask/src/study/pages/same_bytes.rs"]];

/// A car with 3 × 4 elements.
const CAR: &str = r#"
name = "car"
seed = 3
frames = 2
frame_interval_s = 0.2
[noise]
noise_figure_db = 12.0
[[target]]
kind = "mesh"
id = "car-1"
class = "car"
model = "car-hatchback"
lane = 2
y_m = 30.0
velocity_mps = [0.0, -8.0, 0.0]
"#;

/// A motorcycle and a van on a road, with 6 × 8 elements.
const ROAD: &str = r#"
name = "road"
seed = 4
[radar.array]
preset = "6x8"
[noise]
noise_figure_db = 12.0
[road]
substance = "asphalt"
[fidelity]
accuracy_db = -10.0
bounces = 2
[[target]]
kind = "mesh"
id = "motorcycle-1"
class = "motorcycle"
model = "motorcycle-street"
lane = 1
y_m = 24.0
velocity_mps = [0.0, -5.0, 0.0]
[[target]]
kind = "mesh"
id = "van-1"
class = "car"
model = "car-van"
lane = 2
y_m = 40.0
velocity_mps = [0.0, 0.0, 0.0]
"#;

/// Files of both runs and of the table, in the order of the chain.
const FILES: [&str; 11] = [
    "car/scene.scene",
    "car/frames.paths",
    "car/frames.cube",
    "car/frames.rdm",
    "car/frames.points",
    "road/scene.scene",
    "road/frames.paths",
    "road/frames.cube",
    "road/frames.rdm",
    "road/frames.points",
    "table.npy",
];

pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let folder = tempfile::tempdir().map_err(|e| Failure::System(format!("no temporary folder: {e}")))?;
    let (mut part, variants) = (PageSection::default(), variants::all(extent)?);
    part.head(&[
        "program",
        "files with the same bytes",
        "S of paths, dB",
        "cube, dB",
        "range, m",
        "velocity, m/s",
        "azimuth, °",
        "S of the table, dB",
    ]);
    let work = Work::begin("variants");
    let reference = run_variant(&variants[0], folder.path(), 0)?;
    for (number, variant) in variants.iter().enumerate() {
        work.at(number, variants.len());
        let made = if number == 0 { reference.clone() } else { run_variant(variant, folder.path(), number)? };
        let same = FILES.iter().filter(|file| identical(&reference.join(file), &made.join(file))).count();
        let differences = Differences::of(&reference, &made)?;
        let mut cells = vec![variant.name.to_owned(), format!("{same} of {}", FILES.len())];
        cells.extend(differences.cells());
        part.row(&cells);
        if let Some(broken) = variant.promise.broken(FILES.len() - same, &differences) {
            part.complain(format!("{}: {broken}", variant.name));
        }
    }
    Ok(part)
}

/// Makes all files of a variant in a separate folder.
fn run_variant(variant: &Variant, folder: &Path, number: usize) -> Result<std::path::PathBuf, Failure> {
    let out = folder.join(number.to_string());
    let system = |e: std::io::Error| Failure::System(format!("{}: {e}", out.display()));
    std::fs::create_dir(&out).map_err(system)?;
    for (name, scene) in [("car", CAR), ("road", ROAD)] {
        // The scene's own path enters its products, so all variants read the same file.
        let file = folder.join(format!("{name}.toml"));
        std::fs::write(&file, scene).map_err(system)?;
        variant.run(&["run", &text(&file), "--no-cache", "--quiet", "--out", &text(&out.join(name))])?;
    }
    let table = text(&out.join("table.npy"));
    let aspects = ["--freq-ghz", "77", "--az-deg", "0:90:7", "--quiet", "--out", &table];
    variant.run(&[&["rcs", "motorcycle-street"][..], &aspects].concat())?;
    Ok(out)
}

fn text(path: &Path) -> String {
    path.display().to_string()
}
