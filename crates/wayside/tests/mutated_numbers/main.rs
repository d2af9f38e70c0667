//! Every number of a scene, mutated: sign, zero, subnormal, huge, NaN, infinity, a little beyond its range,
//! any. Each scene is read and planned or refused with file, place and rule; and some of those that are read
//! are run, within a minute and gibibytes.
//!
//! ```text
//! WAYSIDE_NUMBERS=40          mutations of each number (6); 40 make 4,000 scenes
//! WAYSIDE_NUMBERS_RUN=5       one in so many of the scenes that are read goes through the program (40)
//! WAYSIDE_NUMBERS_SEED=2      other numbers (1)
//! ```

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

#[path = "../common/mod.rs"]
mod common;
mod numbers;

use common::bounded::{self, Ended};
use numbers::{NUMBERS, Number, scene_with};
use scene::ReadOptions;
use std::collections::BTreeSet;
use std::path::Path;
use std::time::{Duration, Instant};

/// A sheet with a material and traffic of two cars.
const SHEET: &str = "v 0 0 0\nv 1 0 0.5\nv 1 1 0.5\nv 0 1 0\nusemtl paint\nf 1 2 3 4\n";
const TRAFFIC: &str = "<fcd-export>\n<timestep time=\"0\"><vehicle id=\"a\" x=\"2\" y=\"20\" angle=\"180\" type=\"car\" speed=\"3\"/></timestep>\n<timestep time=\"0.3\"><vehicle id=\"a\" x=\"2\" y=\"19.1\" angle=\"180\" type=\"car\" speed=\"3\"/></timestep>\n</fcd-export>\n";

/// A hundred thousand times what reading takes; on a machine with much else to do.
const LONGEST: Duration = Duration::from_secs(300);

/// A body scaled to a kilometre before the radar takes as long as it is said to, and is no fault.
const TOLD_LONG_S: f64 = 60.0;

fn asked(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(otherwise)
}

/// SplitMix64 (Steele et al. 2014).
fn noise(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[test]
fn every_key_of_a_scene_that_holds_a_number_is_mutated() {
    let known: BTreeSet<&str> = scene::keys::TABLES.iter().flat_map(scene::keys::Table::numbers).collect();
    let inside = ["permittivity", "thickness_mm", "unit_scale", "vehicle_seed"];
    let numbers: BTreeSet<&str> = NUMBERS.iter().map(|n| n.key).chain(inside).collect();
    for key in known {
        assert!(numbers.contains(key), "`{key}`: add it to numbers.rs, and how it is written");
    }
}

#[test]
fn a_scene_with_any_number_is_read_and_run_or_refused_with_file_place_and_rule() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("sheet.obj"), SHEET).unwrap();
    std::fs::write(folder.path().join("t.fcd.xml"), TRAFFIC).unwrap();
    let mut state = asked("WAYSIDE_NUMBERS_SEED", 1);
    let (each, one_in) = (asked("WAYSIDE_NUMBERS", 6), asked("WAYSIDE_NUMBERS_RUN", 40).max(1));
    let (mut scenes, mut read, mut run) = (0_u64, 0_u64, 0_u64);
    for number in NUMBERS {
        for value in values(number, folder.path(), each, &mut state) {
            scenes += 1;
            if !is_read(folder.path(), number, &value) {
                continue;
            }
            read += 1;
            if noise(&mut state).is_multiple_of(one_in) && is_short(number, &value) {
                run += 1;
                try_program(folder.path(), number, &value);
            }
        }
    }
    let came = format!("{read} read, {run} of these run, {} refused", scenes - read);
    common::tell_cases("numbers of scenes", scenes, &came);
    assert!(read > scenes / 10 && scenes - read > scenes / 10, "{read} of {scenes} are read");
}

/// Frames are as many as one asks for.
fn is_short(number: &Number, value: &str) -> bool {
    number.key != "frames" || value.parse::<f64>().is_ok_and(|frames| frames <= 3.0)
}

/// Strange numbers, the ends of the range that a refusal tells and what lies about them, and random ones.
fn values(number: &Number, folder: &Path, each: u64, state: &mut u64) -> Vec<String> {
    const STRANGE: [&str; 20] = [
        "0",
        "-0.0",
        "-1",
        "1",
        "5e-324",
        "-1e-310",
        "1e-30",
        "1e308",
        "-1e308",
        "nan",
        "-inf",
        "9223372036854775808",
        "1e16",
        "0.5",
        "2",
        "1e-9",
        "1000",
        "65537",
        "-99999999999999999999999",
        "1e400",
    ];
    let mut all = ends(number, folder);
    all.extend(STRANGE.map(str::to_owned));
    let any = |state: &mut u64| match noise(state) % 3 {
        0 => format!("{:e}", f64::from_bits(noise(state))).replace("NaN", "nan"),
        1 => format!("{}", noise(state) >> (noise(state) % 64)),
        _ => format!(
            "{:.6}",
            ((noise(state) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0)
                * 10_f64.powi((noise(state) % 9) as i32 - 3)
        ),
    };
    all.extend((0..each).map(|_| any(state)));
    // Every number gets some of each kind, whatever their number.
    (0..each).map(|_| all[(noise(state) % all.len() as u64) as usize].clone()).collect()
}

/// Ends of a number's range, each with its neighbours, from the sentences that refuse what lies in no range.
fn ends(number: &Number, folder: &Path) -> Vec<String> {
    let mut ends = vec![];
    for beyond in ["nan", "99999999999999999999999999", "-99999999999999999999999999"] {
        let told = read(folder, number, beyond).err().unwrap_or_default();
        let Some((_, range)) = told.split_once("must be a number ") else { continue };
        let range = range.split(", is").next().unwrap_or_default();
        for end in range.split([' ', ',']).filter_map(|word| word.parse::<f64>().ok()) {
            ends.extend(
                [end, end.next_down(), end.next_up(), end - 1.0, end + 1.0].map(|x| written(x, number)),
            );
        }
    }
    ends
}

/// A whole number where the range has no other.
fn written(value: f64, number: &Number) -> String {
    let whole = value.fract() == 0.0 && value.abs() < 1e15 && !number.written.contains('.');
    if whole { format!("{value:.0}") } else { format!("{value:e}") }
}

fn read(folder: &Path, number: &Number, value: &str) -> Result<(), String> {
    let file = folder.join("m.toml");
    std::fs::write(&file, scene_with(number, value)).unwrap();
    let start = Instant::now();
    let options = ReadOptions::whole();
    let header = std::panic::catch_unwind(|| scene::read(&file, &options));
    let about = || format!("{} = {value}:\n{}", number.key, scene_with(number, value));
    assert!(start.elapsed() < LONGEST, "{} takes {:?}", about(), start.elapsed());
    header.unwrap_or_else(|_| panic!("{}", about())).map(drop).map_err(|errors| errors.to_string())
}

fn is_read(folder: &Path, number: &Number, value: &str) -> bool {
    let Err(told) = read(folder, number, value) else { return true };
    for line in told.lines().filter(|line| line.contains("m.toml")) {
        let place = line.split_once("m.toml:").map_or("", |(_, behind)| behind);
        let mut parts = place.splitn(3, ':');
        let numbers = [parts.next(), parts.next()].map(|part| part.and_then(|p| p.parse::<u32>().ok()));
        assert!(
            numbers.iter().all(Option::is_some) && parts.next().is_some_and(|rule| rule.len() > 10),
            "{value}: {told}"
        );
    }
    assert!(told.contains("m.toml"), "{value}: {told}");
    false
}

/// The program plans it and, unless it says that this may take long, runs it.
fn try_program(folder: &Path, number: &Number, value: &str) {
    let planned = tried(folder, number, value, &["--dry-run"]);
    if most_seconds(&planned.printed).is_none_or(|seconds| seconds < TOLD_LONG_S) {
        tried(folder, number, value, &[]);
    }
}

/// Exit code 0, or 1 or 2 with a sentence.
fn tried(folder: &Path, number: &Number, value: &str, mode: &[&str]) -> Ended {
    let words = ["run", "m.toml", "--out", "out", "--no-cache", "--quiet", "--threads", "1"];
    let ended = bounded::run(folder, words.iter().chain(mode));
    let is_told = ended.status.success() || ended.is_refused();
    let Ended { status, said, after, .. } = &ended;
    assert!(is_told, "{status} {mode:?} after {after:?}: {said}\n{}", scene_with(number, value));
    ended
}

/// The upper end of the processor time that a dry run tells: `1 frames: 20 s, 10 to 40 s of processor time;
/// …`.
fn most_seconds(printed: &str) -> Option<f64> {
    let (told, _) = printed.split_once(" s of processor time")?;
    told.split(' ').next_back()?.parse().ok()
}

#[test]
fn what_a_dry_run_tells_is_read() {
    assert_eq!(most_seconds("1 frames: 4106 s, 2053 to 8213 s of processor time; about"), Some(8213.0));
}
