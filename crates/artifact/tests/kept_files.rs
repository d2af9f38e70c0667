//! Files of today's versions are read and written again to the byte, so that no record changes its shape
//! under an old number; files of the version before are refused by name.
#![allow(clippy::unwrap_used, reason = "a helper of tests fails the test")]

use artifact::classes::Classes;
use artifact::cube::Cube;
use artifact::dataset::Dataset;
use artifact::model::Model;
use artifact::paths::Paths;
use artifact::points::Points;
use artifact::rcs::Rcs;
use artifact::rdm::Rdm;
use artifact::scene::Scene;
use artifact::tracks::Tracks;
use artifact::{Reader, Schema, Writer, read_preamble};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

fn project(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name)
}

/// The kept file of a kind.
fn kept<S: Schema>() -> PathBuf {
    match S::NAME {
        "model" => project("fixtures/classifier.model"),
        name => project("fixtures/artifacts").join(format!("small.{name}")),
    }
}

/// A schema as it was one version earlier, with the same records.
struct Earlier<S>(PhantomData<S>);

impl<S: Schema> Schema for Earlier<S> {
    const NAME: &'static str = S::NAME;
    const VERSION: u32 = S::VERSION - 1;
    type Header = S::Header;
    type Frame = S::Frame;
}

/// Writes what a kept file holds as an artifact of a schema of the same records.
fn written_as<S: Schema, As: Schema<Header = S::Header, Frame = S::Frame>>(file: &Path) {
    let (preamble, reader) = (read_preamble(&kept::<S>()).unwrap(), Reader::<S>::open(&kept::<S>()).unwrap());
    let mut writer = Writer::<As>::create(file, &preamble.provenance, reader.header()).unwrap();
    reader.for_each(|frame| writer.write(&frame.unwrap()).unwrap());
    writer.finish().unwrap();
}

fn check<S: Schema>() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("again");
    written_as::<S, S>(&file);
    let is_same = std::fs::read(&file).unwrap() == std::fs::read(kept::<S>()).unwrap();
    assert!(is_same, "{}: written again it is another file: a new shape needs a new version", S::NAME);
    written_as::<S, Earlier<S>>(&file);
    let refusal = Reader::<S>::open(&file).map(drop).unwrap_err().to_string();
    let rule = format!("`{}` version {}; this program reads version {}", S::NAME, S::VERSION - 1, S::VERSION);
    assert!(refusal.ends_with(&rule), "{refusal}");
}

/// All kinds of artifacts.
const KINDS: [(&str, u32, fn()); 10] = [
    of::<Scene>(),
    of::<Paths>(),
    of::<Rcs>(),
    of::<Cube>(),
    of::<Rdm>(),
    of::<Points>(),
    of::<Tracks>(),
    of::<Dataset>(),
    of::<Model>(),
    of::<Classes>(),
];

const fn of<S: Schema>() -> (&'static str, u32, fn()) {
    (S::NAME, S::VERSION, check::<S>)
}

#[test]
fn kept_files_of_every_kind_are_written_again_to_the_byte_and_earlier_versions_are_refused() {
    KINDS.iter().for_each(|(_, _, check)| check());
}

#[test]
fn the_page_of_versions_tells_those_of_today() {
    let page = std::fs::read_to_string(project("docs/decisions/schema-versions.md")).unwrap();
    for (name, version, _) in KINDS {
        let row = [format!("| `{name}` | {version} |"), format!("| `{name}` (cache only) | {version} |")];
        assert!(row.iter().any(|row| page.contains(row.as_str())), "{name}: version {version} is not told");
    }
}

/// Found by fuzzing (seed 132): `export --to nuscenes` asked for 34 GB of a header with 2³² − 1 samples.
#[test]
fn points_of_a_radar_of_more_values_than_a_cube_has_are_refused() {
    let reader = Reader::<Points>::open(&kept::<Points>()).unwrap();
    let mut header = reader.header().clone();
    let mut frames = Vec::new();
    reader.for_each(|frame| frames.push(frame.unwrap()));
    assert_eq!(Points::contradiction(&header, &frames[0]), None);
    header.cube.as_mut().unwrap().radar.waveform.samples = u32::MAX;
    let refusal = Points::contradiction(&header, &frames[0]).unwrap();
    assert!(refusal.contains("values a frame"), "{refusal}");
}
