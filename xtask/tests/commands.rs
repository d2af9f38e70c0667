//! The commands that only developers have, and those of the program, passed on.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

#[path = "../../crates/wayside/tests/common/mod.rs"]
mod common;

use common::killing::{begin_anew, files, is_temporary, killed_after};
use common::{Workplace, asked};
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

#[test]
#[ignore = "takes minutes: cargo test --release -p xtask --test commands -- --include-ignored"]
fn a_study_that_is_killed_leaves_nothing_half_written() {
    let words = "chart --quick --out out --quiet";
    // Its seconds differ from run to run: a table that is there ends with a line's end, a picture as pictures
    // do.
    let ends: [(&str, &[u8]); 3] =
        [("chart.csv", b"\n"), ("chart.svg", b"</svg>"), ("chart.png", b"IEND\xaeB`\x82")];
    let place = Workplace::new();
    let start = Instant::now();
    place.run(words);
    let duration = start.elapsed();
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut kills = 0;
    for _ in 0..asked("WAYSIDE_KILLS", 3) {
        // Most of the time nothing is written; half of the kills fall into the end.
        let share = if random.random::<bool>() {
            random.random::<f64>()
        } else {
            1.0 - 0.05 * random.random::<f64>()
        };
        begin_anew(&place);
        kills += u64::from(killed_after(&place, words, duration.mul_f64(share)));
        for (name, end) in ends {
            let file = place.path("out").join(name);
            let bytes = std::fs::read(&file).unwrap_or_else(|_| end.to_vec());
            assert!(bytes.trim_ascii_end().ends_with(end.trim_ascii_end()), "{name} is half-written");
        }
    }
    place.run(words);
    assert!(files(&place.path("out")).iter().all(|file| !is_temporary(file)));
    println!("{words}: {kills} kills within {duration:.1?}");
}
