//! Artifacts whose checksums are right and whose content is not: every command that reads them ends with exit
//! code 0, 1 or 2, within a minute and gibibytes, and does not panic.
//!
//! ```text
//! WAYSIDE_CRAFTED=5000        cases (60)
//! WAYSIDE_CRAFTED_MINUTES=30  as long instead
//! WAYSIDE_CRAFTED_SEED=2      other cases (1)
//! ```

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

use crate::common::bounded::{self, Ended};
use crate::common::{SMALL_SCENE, Workplace, tell_cases};
use artifact::cube::{Cube, CubeHeader};
use artifact::rdm::Rdm;
use artifact::{Reader, Schema, Writer};
use std::path::Path;
use std::time::Instant;

/// Magic, then records: a mark of one byte but before the first, a length of eight, a checksum of sixteen,
/// the content.
const MAGIC_BYTES: usize = 8;
const SUM_BYTES: usize = 16;

/// Commands that read each kind of artifact, `F` for the file.
const COMMANDS: [(&str, &[&str]); 7] = [
    ("scene", &["inspect F", "export F --to json --out x"]),
    (
        "paths",
        &[
            "inspect F",
            "export F --to csv --out x",
            "export F --to json --out x",
            "echo small.toml --paths F --out x",
        ],
    ),
    ("rcs", &["inspect F", "export F --to npy --out x.npy", "export F --to json --out x"]),
    (
        "cube",
        &[
            "inspect F",
            "dsp F --pictures --out maps",
            "export F --to npy --out x.npy",
            "export F --to sigmf --out x",
            "export F --to dca1000 --out x.bin",
            "calibrate F --at-m 2,30,1 --out x.csv",
        ],
    ),
    (
        "rdm",
        &[
            "inspect F",
            "export F --to npy --out x.npy",
            "export F --to exr --out x.exr",
            "export F --to png --out x.png",
            "classify MODEL F",
        ],
    ),
    (
        "points",
        &[
            "inspect F",
            "export F --to csv --out x",
            "export F --to pcd --out x",
            "export F --to ply --out x",
            "export F --to json --out x",
        ],
    ),
    ("tracks", &["inspect F", "export F --to csv --out x", "export F --to json --out x"]),
];

fn asked<T: std::str::FromStr>(name: &str) -> Option<T> {
    std::env::var(name).ok()?.parse().ok()
}

/// SplitMix64 (Steele et al. 2014).
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

/// Byte ranges of the records' contents.
fn records(bytes: &[u8]) -> Vec<std::ops::Range<usize>> {
    let (mut found, mut at) = (vec![], MAGIC_BYTES);
    loop {
        let length = u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize;
        let start = at + 8 + SUM_BYTES;
        found.push(start..start + length);
        if bytes[start + length] == b'E' {
            return found;
        }
        at = start + length + 1;
    }
}

/// One to three changes of the content of records, their lengths kept and their checksums made anew.
fn crafted(noise: &mut Noise, sound: &[u8]) -> Vec<u8> {
    let mut bytes = sound.to_vec();
    let records = records(sound);
    for _ in 0..=noise.below(3) {
        let record = records[1 + noise.below(records.len() - 1)].clone();
        change(noise, &mut bytes[record.clone()]);
        let sum = blake3::hash(&bytes[record.clone()]);
        bytes[record.start - SUM_BYTES..record.start].copy_from_slice(&sum.as_bytes()[..SUM_BYTES]);
    }
    bytes
}

/// A byte, a number of four or eight bytes, or a piece that is moved; the beginning, where lengths stand,
/// more often.
fn change(noise: &mut Noise, content: &mut [u8]) {
    let end = [content.len(), content.len().min(300), content.len().min(24)][noise.below(3)];
    let at = noise.below(end);
    let strange = [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e308, 5e-324, -0.0, 1e19][noise.below(8)];
    let small = [f32::NAN, f32::INFINITY, -f32::MAX, 1e-45][noise.below(4)].to_le_bytes();
    match noise.below(6) {
        0 => content[at] ^= 1 << noise.below(8),
        1 => content[at] = [0, 1, 250, 251, 252, 253, 255][noise.below(7)],
        2 => content.iter_mut().skip(at).zip(strange.to_le_bytes()).for_each(|(byte, new)| *byte = new),
        3 => content.iter_mut().skip(at).zip(small).for_each(|(byte, new)| *byte = new),
        4 => content.iter_mut().skip(at).zip(noise.next().to_le_bytes()).for_each(|(byte, new)| *byte = new),
        _ => content[at..].rotate_left(noise.below(9).min(end - at)),
    }
}

fn sound_artifacts(place: &Workplace) -> Vec<(&'static str, Vec<u8>)> {
    place.run("run small.toml --out out");
    let tables = SMALL_SCENE.replace("[noise]", "[fidelity]\necho = \"rcs-table\"\n[noise]");
    std::fs::write(place.path("tables.toml"), tables.replace("name = \"small\"", "name = \"tables\""))
        .unwrap();
    place.run("run tables.toml --out tables");
    let read = |name: &str| std::fs::read(place.path(name)).unwrap();
    let file = |kind: &str| match kind {
        "scene" => read("out/scene.scene"),
        "rcs" => read("tables/frames.rcs"),
        kind => read(&format!("out/frames.{kind}")),
    };
    COMMANDS.map(|(kind, _)| (kind, file(kind))).to_vec()
}

/// Whether the command took the file; ends the test where it neither did nor refused it.
fn try_command(place: &Workplace, words: &str, about: &str) -> bool {
    let ended = bounded::run(place.root(), words.split_whitespace().chain(["--quiet"]));
    if !(ended.status.success() || ended.is_refused()) {
        let kept = std::env::temp_dir().join("wayside-crafted");
        std::fs::copy(place.path("F"), &kept).unwrap();
        let (kept, Ended { status, said, after, .. }) = (kept.display(), ended);
        panic!("{words}: {about}, kept as {kept}: {status} after {after:?}: {said}");
    }
    ended.status.success()
}

#[test]
fn artifacts_of_right_checksums_and_wrong_content_do_not_make_a_command_panic() {
    let place = Workplace::new();
    let sound = sound_artifacts(&place);
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/classifier.model");
    let seed: u64 = asked("WAYSIDE_CRAFTED_SEED").unwrap_or(1);
    let (cases, minutes) =
        (asked("WAYSIDE_CRAFTED").unwrap_or(60_u64), asked::<f64>("WAYSIDE_CRAFTED_MINUTES"));
    let start = Instant::now();
    let (mut done, mut taken) = (0_u64, 0_u64);
    while minutes.map_or(done < cases, |minutes| start.elapsed().as_secs_f64() < 60.0 * minutes) {
        let (kind, commands) = COMMANDS[done as usize % COMMANDS.len()];
        let mut noise = Noise(seed.wrapping_mul(0xd1b5_4a32_d192_ed03) ^ done);
        let (_, bytes) = sound.iter().find(|(known, _)| *known == kind).unwrap();
        std::fs::write(place.path("F"), crafted(&mut noise, bytes)).unwrap();
        let words = commands[noise.below(commands.len())].replace("MODEL", model);
        taken += u64::from(try_command(&place, &words, &format!("{kind}, seed {seed}, case {done}")));
        done += 1;
    }
    tell_cases("crafted artifacts", done, &format!("{taken} read, {} refused", done - taken));
}

/// The artifact once more, its header with chirps of 2²⁰ samples before the frames as they were.
fn with_long_chirps<S: Schema<Header = CubeHeader>>(file: &Path, out: &Path) {
    let reader = Reader::<S>::open(file).unwrap();
    let (from, mut header) = (reader.preamble().provenance.clone(), reader.header().clone());
    header.radar.waveform.samples = 1 << 20;
    let frames: Vec<S::Frame> = reader.map(Result::unwrap).collect();
    let mut writer = Writer::<S>::create(out, &from, &header).unwrap();
    frames.iter().for_each(|frame| writer.write(frame).unwrap());
    writer.finish().unwrap();
}

#[test]
fn a_file_too_short_for_its_headers_frames_is_refused_when_it_is_opened() {
    let place = Workplace::new();
    place.run("run small.toml --out out");
    with_long_chirps::<Cube>(&place.path("out/frames.cube"), &place.path("long.cube"));
    with_long_chirps::<Rdm>(&place.path("out/frames.rdm"), &place.path("long.rdm"));
    for words in ["dsp long.cube --out maps", "export long.rdm --to png --out x.png"] {
        let ended = bounded::run(place.root(), words.split_whitespace());
        assert!(ended.is_refused(), "{words}: {}", ended.said);
        assert!(ended.said.contains("do not fit in the"), "{words}: {}", ended.said);
    }
}
