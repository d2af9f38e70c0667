//! Promises of the envelope, on artifacts made here.

#![allow(clippy::unwrap_used, reason = "a helper of tests fails the test")]

use artifact::dataset::{CropFormat, Dataset};
use artifact::points::{Height, Point, Points, PointsFrame, PointsHeader};
use artifact::rdm::Rdm;
use artifact::{Fault, Provenance, Reader, Schema, Writer, read_preamble};
use std::path::{Path, PathBuf};

const FRAMES: u32 = 3;

fn point(i: u32) -> Point {
    let x = f64::from(i);
    Point {
        range_m: 30.0 + x,
        radial_velocity_mps: -x,
        azimuth_rad: 0.1,
        elevation_rad: -0.1,
        position_m: [x, 30.0, 0.75],
        snr_db: 20.0,
        object: Some(i),
        target: None,
        label: None,
        two_ways_rad: None,
        stationary: None,
        height: Height::Assumed,
    }
}

fn frame(index: u32) -> PointsFrame {
    let points = (0..index + 1).map(point).collect();
    PointsFrame { index, time_s: 0.1 * f64::from(index), points, objects: vec![] }
}

fn provenance() -> Provenance {
    Provenance { stage: "test".into(), program_version: "0".into(), seed: 7, ..Provenance::default() }
}

fn write(file: &Path) {
    let mut writer = Writer::<Points>::create(file, &provenance(), &PointsHeader::default()).unwrap();
    (0..FRAMES).for_each(|i| writer.write(&frame(i)).unwrap());
    writer.finish().unwrap();
}

fn written() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("deep/frames.points");
    write(&file);
    (folder, file)
}

fn read(file: &Path) -> Result<Vec<PointsFrame>, artifact::ArtifactError> {
    Reader::<Points>::open(file)?.collect()
}

#[test]
fn what_is_written_is_read_back() {
    let (_folder, file) = written();
    assert_eq!(read(&file).unwrap(), (0..FRAMES).map(frame).collect::<Vec<_>>());
    assert_eq!(Reader::<Points>::open(&file).unwrap().frames(), u64::from(FRAMES));
    let preamble = read_preamble(&file).unwrap();
    assert_eq!(
        (preamble.schema.as_str(), preamble.version, preamble.provenance),
        ("points", Points::VERSION, provenance())
    );
}

#[test]
fn equal_content_is_equal_bytes() {
    let (_a, first) = written();
    let (_b, second) = written();
    assert_eq!(std::fs::read(first).unwrap(), std::fs::read(second).unwrap());
}

#[test]
fn every_truncation_is_refused_before_a_frame_is_handed_out() {
    let (folder, file) = written();
    let whole = std::fs::read(&file).unwrap();
    let cut = folder.path().join("cut.points");
    for length in 0..whole.len() {
        std::fs::write(&cut, &whole[..length]).unwrap();
        assert!(
            Reader::<Points>::open(&cut).is_err(),
            "{length} of {} bytes were taken for whole",
            whole.len()
        );
    }
}

#[test]
fn every_flipped_bit_is_refused() {
    let (folder, file) = written();
    let whole = std::fs::read(&file).unwrap();
    let damaged = folder.path().join("damaged.points");
    for bit in 0..8 * whole.len() {
        let mut bytes = whole.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        std::fs::write(&damaged, &bytes).unwrap();
        assert!(read(&damaged).is_err(), "bit {bit} of byte {}", bit / 8);
    }
}

#[test]
fn bytes_behind_the_end_are_refused() {
    let (_folder, file) = written();
    let mut bytes = std::fs::read(&file).unwrap();
    bytes.extend_from_slice(&[0; 3]);
    std::fs::write(&file, bytes).unwrap();
    assert!(matches!(Reader::<Points>::open(&file).map(drop).unwrap_err().fault, Fault::MissingEnd));
}

#[test]
fn a_length_beyond_the_file_is_refused_before_it_is_allocated() {
    let (_folder, file) = written();
    let mut bytes = std::fs::read(&file).unwrap();
    bytes[8..16].copy_from_slice(&(1_u64 << 60).to_le_bytes());
    std::fs::write(&file, bytes).unwrap();
    let fault = read_preamble(&file).unwrap_err().fault;
    assert!(matches!(fault, Fault::TooLong { offset: 8, length: 0x1000_0000_0000_0000, .. }), "{fault}");
}

#[test]
fn another_kind_of_artifact_is_refused_by_name() {
    let (_folder, file) = written();
    let error = Reader::<Rdm>::open(&file).map(drop).unwrap_err();
    assert!(
        error.to_string().ends_with("is a `points` artifact where a `rdm` artifact is needed"),
        "{error}"
    );
}

/// The schema of points, one version later.
struct Later;

impl Schema for Later {
    const NAME: &'static str = "points";
    const VERSION: u32 = Points::VERSION + 1;
    type Header = PointsHeader;
    type Frame = PointsFrame;
}

#[test]
fn a_newer_version_is_refused_naming_both() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("new.points");
    Writer::<Later>::create(&file, &provenance(), &PointsHeader::default()).unwrap().finish().unwrap();
    let error = Reader::<Points>::open(&file).map(drop).unwrap_err();
    let [newer, known] = [Later::VERSION, Points::VERSION];
    let expected = format!("`points` version {newer}; this program reads version {known}");
    assert!(error.to_string().ends_with(&expected), "{error}");
}

/// A NaN equals nothing, so a header with one would seem changed at every second look, and plans made from it
/// are arbitrary.
#[test]
fn a_header_with_a_nan_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("nan.dataset");
    let header = CropFormat {
        side: 64,
        range_span_m: 24.0,
        velocity_span_mps: f64::NAN,
        floor_db: 0.0,
        ceiling_db: 30.0,
    };
    Writer::<Dataset>::create(&file, &provenance(), &header).unwrap().finish().unwrap();
    let error = Reader::<Dataset>::open(&file).map(drop).unwrap_err();
    assert!(error.to_string().contains("the header is not of the schema's shape"), "{error}");
    assert!(error.to_string().ends_with("one of its numbers is NaN"), "{error}");
}

#[test]
fn an_unfinished_write_leaves_the_old_artifact_and_nothing_else() {
    let (_folder, file) = written();
    let before = std::fs::read(&file).unwrap();
    let mut writer = Writer::<Points>::create(&file, &provenance(), &PointsHeader::default()).unwrap();
    writer.write(&frame(9)).unwrap();
    drop(writer);
    assert_eq!(std::fs::read(&file).unwrap(), before);
    assert_eq!(std::fs::read_dir(file.parent().unwrap()).unwrap().count(), 1);
}

#[test]
fn a_missing_file_is_the_systems_fault_and_foreign_bytes_are_the_files() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("x.points");
    assert!(read(&file).unwrap_err().is_system());
    std::fs::write(&file, "name = \"not an artifact\"").unwrap();
    let error = read(&file).unwrap_err();
    assert!(!error.is_system() && matches!(error.fault, Fault::Magic));
}
