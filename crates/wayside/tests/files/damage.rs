//! Damaged artifacts and cache entries: never a panic, never taken for right. A part of them by default; as
//! many as `WAYSIDE_DAMAGES` says, drawn from `WAYSIDE_SEED`, when asked for.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::{SMALL_SCENE, Workplace, asked, tell_cases};
use artifact::{Reader, Schema};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::path::{Path, PathBuf};

/// One way in which a file is no longer what it was.
fn damaged(whole: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = whole.to_vec();
    let at = random.random_range(0..bytes.len());
    match random.random_range(0..7) {
        0 | 1 => bytes[at] ^= 1 << random.random_range(0..8),
        2 => bytes.truncate(at),
        3 => bytes.insert(at, random.random()),
        4 => drop(bytes.remove(at)),
        5 => {
            let end = (at + random.random_range(1..64)).min(bytes.len());
            bytes[at..end].iter_mut().for_each(|byte| *byte = random.random());
        }
        _ => {
            let from = random.random_range(0..bytes.len());
            let length = random.random_range(1..256).min(bytes.len() - from.max(at));
            bytes.copy_within(from..from + length, at);
        }
    }
    bytes
}

/// A damage that has changed something.
fn changed(whole: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    loop {
        let bytes = damaged(whole, random);
        if bytes != whole {
            return bytes;
        }
    }
}

/// Everything that a reader hands out of a file, as JSON, if it finds nothing wrong.
fn accepted<S: Schema>(file: &Path) -> Option<String> {
    let mut reader = Reader::<S>::open(file).ok()?;
    let frames: Vec<S::Frame> = reader.by_ref().collect::<Result<_, _>>().ok()?;
    Some(serde_json::to_string(&(reader.header(), frames)).unwrap())
}

type Accepted = fn(&Path) -> Option<String>;

/// One artifact of every kind, the reader of its content and a command that takes it.
fn artifacts(place: &Workplace) -> Vec<(&'static str, Accepted, &'static str)> {
    use artifact::{classes, cube, dataset, model, paths, points, rcs, rdm, scene, tracks};
    std::fs::write(place.path("table.toml"), format!("{SMALL_SCENE}\n[fidelity]\necho = \"rcs-table\"\n"))
        .unwrap();
    std::fs::write(place.path("base.toml"), BASE).unwrap();
    std::fs::write(place.path("spec.toml"), RECIPE).unwrap();
    place.run("run small.toml --out a --quiet");
    place.run("run table.toml --out t --no-cache --quiet");
    place.run("dataset spec.toml --out d --quiet");
    std::fs::copy(Workplace::project_file("fixtures/classifier.model"), place.path("m.model")).unwrap();
    let classes =
        entries(place).into_iter().find(|entry| entry.extension().is_some_and(|e| e == "classes")).unwrap();
    std::fs::copy(classes, place.path("c.classes")).unwrap();
    vec![
        ("a/scene.scene", accepted::<scene::Scene> as Accepted, "export x --to json --out y"),
        ("a/frames.paths", accepted::<paths::Paths>, "echo small.toml --paths x --out y --quiet"),
        ("t/frames.rcs", accepted::<rcs::Rcs>, "export x --to npy --out y"),
        ("a/frames.cube", accepted::<cube::Cube>, "dsp x --out z --quiet"),
        ("a/frames.rdm", accepted::<rdm::Rdm>, "classify m.model x"),
        ("a/frames.points", accepted::<points::Points>, "export x --to csv --out y"),
        ("a/frames.tracks", accepted::<tracks::Tracks>, "export x --to csv --out y"),
        ("d/shard-0000.dataset", accepted::<dataset::Dataset>, "classify m.model x"),
        ("m.model", accepted::<model::Model>, "classify x a/frames.rdm"),
        ("c.classes", accepted::<classes::Classes>, "inspect x"),
    ]
}

const BASE: &str = "name = \"base\"\n[radar.waveform]\nsamples = 64\nchirps = 16\n[radar.array]\npreset = \"1x4\"\n\
[dsp]\ntraining_cells = [3, 6]\n[fidelity]\nbounces = 1\n";

const RECIPE: &str = "scene = \"base.toml\"\nseed = 1\nscenes_per_class = 2\nrange_m = [25.0, 45.0]\n\
speed_mps = [1.0, 5.0]\nlanes = [1, 2]\nvehicle_seeds = 2\n[models]\nmotorcycle = [\"motorcycle-street\"]\n";

#[test]
fn no_damaged_artifact_is_read_as_another_content() {
    let place = Workplace::new();
    let kinds = artifacts(&place);
    let mut random = ChaCha8Rng::seed_from_u64(asked("WAYSIDE_SEED", 1));
    let each = asked("WAYSIDE_DAMAGES", 400).div_ceil(kinds.len() as u64);
    let (mut refused, mut unharmed, mut by_program) = (0_u64, 0_u64, 0_u64);
    for (file, accepted, command) in kinds {
        let whole = place.bytes(file);
        let right = accepted(&place.path(file)).unwrap_or_else(|| panic!("{file} is whole"));
        for round in 0..each {
            let bytes = changed(&whole, &mut random);
            std::fs::write(place.path("x"), &bytes).unwrap();
            match accepted(&place.path("x")) {
                None => refused += 1,
                // No byte that carries content has changed.
                Some(read) if read == right => unharmed += 1,
                Some(_) => panic!("{file}: damage {round} is taken for right"),
            }
            if round % 16 == 0 {
                let output = place.try_run(command);
                assert_eq!(
                    output.status.code(),
                    Some(1),
                    "{file}, {round}: {}",
                    String::from_utf8_lossy(&output.stderr)
                );
                assert!(!place.path("y").is_file(), "{file}, {round}: something was written");
                by_program += 1;
            }
        }
    }
    let came = format!("{refused} refused, {unharmed} read, {by_program} of them given to a command");
    tell_cases("artifacts", refused + unharmed, &came);
    assert_eq!(unharmed, 0, "every byte of an artifact is under a checksum or is looked at");
}

/// All entries of the cache.
fn entries(place: &Workplace) -> Vec<PathBuf> {
    let mut folders = vec![place.path("cache")];
    let mut files = vec![];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap().flatten() {
            match entry.file_type().unwrap().is_dir() {
                true => folders.push(entry.path()),
                false => files.push(entry.path()),
            }
        }
    }
    files.sort();
    files
}

#[test]
fn no_damaged_cache_entry_changes_a_result() {
    let place = Workplace::new();
    let results =
        ["scene.scene", "frames.paths", "frames.cube", "frames.rdm", "frames.points", "frames.tracks"];
    let classes = |out: &str| place.summary(&format!("{out}/summary.json"))["frames"][0]["targets"].clone();
    place.run("run small.toml --out right --quiet");
    let mut random = ChaCha8Rng::seed_from_u64(asked("WAYSIDE_SEED", 2));
    let (mut damages, mut named) = (0_u64, 0_u64);
    while damages < asked("WAYSIDE_DAMAGES", 120) {
        let mut done = vec![];
        for entry in entries(&place).into_iter().filter(|entry| !entry.ends_with("CACHEDIR.TAG")) {
            let whole = std::fs::read(&entry).unwrap();
            std::fs::write(&entry, changed(&whole, &mut random)).unwrap();
            done.push(entry.file_name().unwrap().to_str().unwrap().to_owned());
        }
        let output = place.try_run("run small.toml --out again --explain");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{said}");
        results.iter().for_each(|file| {
            assert_eq!(
                place.bytes(&format!("again/{file}")),
                place.bytes(&format!("right/{file}")),
                "{file}: {said}"
            );
        });
        assert_eq!(classes("again"), classes("right"));
        damages += done.len() as u64;
        named += done.iter().filter(|name| said.contains(name.as_str())).count() as u64;
    }
    let came = format!("{named} told by name, the same results with all");
    tell_cases("cache entries", damages, &came);
}
