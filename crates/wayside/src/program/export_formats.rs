//! Formats of exported artifacts, each with its writer.

use crate::program::option_words::FormatWord::{self, *};
use artifact::Reader;
use artifact::classes::Classes;
use artifact::model::Model;
use artifact::paths::Paths;
use artifact::points::Points;
use artifact::rcs::Rcs;
use artifact::scene::Scene;
use artifact::tracks::Tracks;
use clap::ValueEnum;
use formats::export::{as_json, cube, dataset, interchange, model, parquet, paths, points, rcs, rdm, tracks};
use formats::raw_data::{dca1000, sigmf};
use formats::training_sets::{carrada, kitti, nuscenes, raddet, uwcr};
use pipeline::host::failure::Failure;
use std::path::Path;

/// Writer of an artifact in a format.
pub(crate) enum Export {
    /// Writes one file, or a pair of files.
    File(fn(&Path, &Path) -> Result<(), Failure>),
    /// Writes a folder in a dataset's layout, labelled if a scene is given.
    Set(fn(&Path, Option<&Path>, &Path) -> Result<(), Failure>),
}

use Export::{File, Set};

/// Artifacts, the formats to which each is exported, and the writers.
const EXPORTS: [(&str, FormatWord, Export); 36] = [
    ("scene", Json, File(as_json::<Scene>)),
    ("paths", Csv, File(|file, out| paths::csv(Reader::open(file)?, out))),
    ("paths", Json, File(as_json::<Paths>)),
    ("paths", Osi, File(|file, out| interchange::osi(file, "paths", out))),
    ("rcs", Npy, File(|file, out| rcs::npy(Reader::open(file)?, out))),
    ("rcs", Json, File(as_json::<Rcs>)),
    ("cube", Npy, File(|file, out| cube::npy(Reader::open(file)?, out))),
    ("cube", Dca1000, File(dca1000::write)),
    ("cube", Sigmf, File(sigmf::write)),
    ("cube", Uwcr, Set(|file, scene, out| uwcr::write(Reader::open(file)?, scene, out))),
    ("rdm", Npy, File(|file, out| rdm::npy(Reader::open(file)?, out))),
    ("rdm", Exr, File(|file, out| rdm::exr(Reader::open(file)?, out))),
    ("rdm", Png, File(|file, out| rdm::png(Reader::open(file)?, out))),
    ("rdm", Raddet, Set(|file, scene, out| raddet::write(Reader::open(file)?, scene, out))),
    ("rdm", Carrada, Set(|file, scene, out| carrada::write(Reader::open(file)?, scene, out))),
    ("points", Csv, File(|file, out| points::csv(Reader::open(file)?, out))),
    ("points", Pcd, File(|file, out| points::pcd(Reader::open(file)?, out))),
    ("points", Ply, File(|file, out| points::ply(Reader::open(file)?, out))),
    ("points", Json, File(as_json::<Points>)),
    ("points", Osi, File(|file, out| interchange::osi(file, "points", out))),
    ("points", Mcap, File(|file, out| interchange::mcap(file, "points", out))),
    ("points", Foxglove, File(interchange::foxglove)),
    ("points", Kitti, Set(kitti::write)),
    ("points", Nuscenes, Set(nuscenes::write)),
    ("points", Parquet, File(|file, out| parquet::points(Reader::open(file)?, out))),
    ("tracks", Csv, File(|file, out| tracks::csv(Reader::open(file)?, out))),
    ("tracks", Json, File(as_json::<Tracks>)),
    ("tracks", Osi, File(|file, out| interchange::osi(file, "tracks", out))),
    ("tracks", Mcap, File(|file, out| interchange::mcap(file, "tracks", out))),
    ("dataset", Csv, File(features)),
    ("dataset", Npy, File(dataset::npy)),
    ("dataset", Png, File(dataset::png)),
    ("dataset", Parquet, File(parquet::samples)),
    ("model", Safetensors, File(model)),
    ("model", Json, File(as_json::<Model>)),
    ("classes", Json, File(as_json::<Classes>)),
];

#[cfg(feature = "classifier")]
fn features(file: &Path, out: &Path) -> Result<(), Failure> {
    formats::export::features::csv(Reader::open(file)?, out)
}

#[cfg(not(feature = "classifier"))]
fn features(_file: &Path, _out: &Path) -> Result<(), Failure> {
    Err(Failure::refused("features of datasets need a program with the feature `classifier`"))
}

/// Finds the writer of a kind of artifact in a format; `None` if there is none.
pub(crate) fn export_of(artifact: &str, format: FormatWord) -> Option<&'static Export> {
    let found = EXPORTS.iter().find(|(known, to, _)| *known == artifact && *to == format);
    found.map(|(.., export)| export)
}

/// Whether a format is a folder in a dataset's layout.
pub(crate) fn is_set(format: FormatWord) -> bool {
    EXPORTS.iter().any(|(_, to, export)| *to == format && matches!(export, Set(_)))
}

/// Names of the formats to which a kind of artifact is exported; empty for an unknown kind.
pub(crate) fn formats_of(artifact: &str) -> String {
    let own = EXPORTS.iter().filter(|(known, ..)| *known == artifact);
    own.map(|(_, to, _)| name_of(*to)).collect::<Vec<_>>().join(", ")
}

/// Word of a format.
pub(crate) fn name_of(format: FormatWord) -> String {
    format.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

/// Help on the formats of each artifact, one line per artifact.
pub(crate) fn help_on_formats() -> String {
    let mut artifacts = EXPORTS.map(|(artifact, ..)| artifact).to_vec();
    artifacts.dedup();
    let line = |artifact: &&str| format!("\n  {:<10} {}", format!(".{artifact}"), formats_of(artifact));
    format!("What goes to which format:{}", artifacts.iter().map(line).collect::<String>())
}
