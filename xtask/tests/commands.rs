//! The commands that only developers have, and those of the program, passed on.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

#[path = "../../crates/wayside/tests/common/mod.rs"]
mod common;

use common::killing::{begin_anew, files, is_killed_after, is_temporary};
use common::{Workplace, asked, tell_cases};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::time::Instant;

#[test]
fn help_is_given_for_every_command_of_developers_and_of_the_program() {
    let place = Workplace::new();
    let commands = ["study", "chart", "atlas", "levels", "bench", "scene-keys", "ci", "run", "rcs", "export"];
    commands
        .iter()
        .for_each(|c| assert!(place.run(&format!("{c} --help")).contains("Usage: cargo xtask"), "{c}"));
}

#[test]
fn a_command_of_the_program_is_passed_on_and_says_how_it_was_typed() {
    let place = Workplace::new();
    place.run("run small.toml --out out --quiet");
    let page = String::from_utf8(place.bytes("out/report.html")).unwrap();
    assert!(page.contains("cargo xtask run small.toml --out out") && page.contains("cargo xtask inspect"));
}

#[test]
fn studies_are_told_with_their_pages_and_one_that_is_not_there_is_refused() {
    let place = Workplace::new();
    let told = place.run("study");
    assert!(
        told.lines()
            .any(|line| line.starts_with("ambiguity ") && line.contains("docs/validation/ambiguity.md"))
    );
    let output = place.try_run("study nothing");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(1) && said.contains("no study `nothing`"), "{said}");
}

#[test]
fn a_study_of_fewer_cases_goes_into_a_copy_of_its_page_that_claims_no_sources() {
    let place = Workplace::new();
    let table = place.run("study calibration --quick --out page.md --quiet");
    let page = String::from_utf8(place.bytes("page.md")).unwrap();
    let original =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/validation/calibration.md"))
            .unwrap();
    assert!(table.contains("| 3 × 4 | calibrated | 40 |") && page.contains(table.trim()), "{table}");
    assert!(page.contains("<!-- made by cargo xtask study calibration from sources unknown -->"));
    assert_eq!(page.lines().next(), original.lines().next());
}

#[test]
fn a_benchmark_is_not_written_where_no_plain_file_can_be() {
    let place = Workplace::new();
    std::fs::create_dir(place.path("folder")).unwrap();
    let output = place.try_run("bench --quick --quiet --out folder");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && said.contains("folder"), "{said}");
}

/// A project of its own around the sources of this one: what a study makes goes there.
fn project_of_its_own() -> Workplace {
    let place = Workplace::new();
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    for name in ["crates", "xtask"] {
        std::os::unix::fs::symlink(root.join(name), place.path(name)).unwrap();
    }
    std::fs::create_dir_all(place.path("docs/pictures")).unwrap();
    std::fs::write(place.path("docs/chart.md"), EARLIER).unwrap();
    place
}

const EARLIER: &str = "# An earlier page\n";

/// End of each file of the chart, whose seconds differ from run to run.
const ENDS: [(&str, &[u8]); 6] = [
    ("docs/chart.md", b"<!-- made by cargo xtask study chart from sources unknown -->\n"),
    ("docs/pictures/chart.csv", b"\n"),
    ("docs/pictures/chart-echo.svg", b"</svg>"),
    ("out/drawn/chart.csv", b"\n"),
    ("out/drawn/chart-echo.svg", b"</svg>"),
    ("out/drawn/chart-echo.png", b"IEND\xaeB`\x82"),
];

fn assert_whole_or_as_before(place: &Workplace) {
    for (name, end) in ENDS {
        let Ok(bytes) = std::fs::read(place.path(name)) else { continue };
        let is_whole = bytes.trim_ascii_end().ends_with(end.trim_ascii_end());
        assert!(is_whole || bytes == EARLIER.as_bytes(), "{name} is half-written");
    }
}

#[test]
fn a_chart_that_is_killed_leaves_pages_whole_and_the_next_one_sweeps_what_is_left() {
    let place = project_of_its_own();
    let words = "chart --quick --only synthesis --docs --out out/drawn --quiet";
    let command = || {
        let mut command = place.command(words);
        command.env("WAYSIDE_PROJECT", place.root()).stdout(std::process::Stdio::null());
        command
    };
    let start = Instant::now();
    assert!(command().status().unwrap().success());
    let duration = start.elapsed();
    let mut random = ChaCha8Rng::seed_from_u64(asked("WAYSIDE_SEED", 5));
    let (mut kills, mut left, asked_for) = (0, 0, asked("WAYSIDE_KILLS", 3));
    while kills < asked_for {
        // Most of the time nothing is written: half of the kills fall into the end.
        let begin = if random.random::<bool>() { 0.0 } else { 0.9 };
        begin_anew(&place);
        std::fs::write(place.path("docs/chart.md"), EARLIER).unwrap();
        let after = duration.mul_f64(begin + (1.0 - begin) * random.random::<f64>());
        kills += u64::from(is_killed_after(&mut command(), after));
        left += files(place.root()).iter().filter(|file| is_temporary(file)).count();
        assert_whole_or_as_before(&place);
    }
    assert!(command().status().unwrap().success());
    assert_whole_or_as_before(&place);
    assert_ne!(place.bytes("docs/chart.md"), EARLIER.as_bytes());
    assert!(files(place.root()).iter().all(|file| !is_temporary(file)));
    let came = format!("{left} temporary files met and swept, pages whole");
    tell_cases(&format!("kills of chart within {duration:.1?}"), kills, &came);
}

#[test]
fn a_part_of_the_chart_that_is_not_there_is_refused() {
    let place = project_of_its_own();
    let words = "chart --quick --only nothing --out out/drawn --quiet";
    let output = place.command(words).env("WAYSIDE_PROJECT", place.root()).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(1) && said.contains("no part of the chart has `nothing`"), "{said}");
}
