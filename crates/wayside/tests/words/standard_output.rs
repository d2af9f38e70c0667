//! Results that cannot be written to standard output are a failure; a reader that has gone away is none.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::Workplace;
use std::process::{Command, Output, Stdio};

/// Runs with one stream going to a file that cannot grow: no file of the process may be longer than it is, 64
/// KiB.
fn on_full_file(place: &Workplace, words: &str, stream: &str) -> Output {
    std::fs::write(place.path("full"), vec![b'x'; 64 << 10]).unwrap();
    let script = format!("ulimit -f 64; trap '' XFSZ; exec \"$0\" {words} {stream}>>full");
    let output = Command::new("bash")
        .args(["-c", &script, crate::common::PROGRAM])
        .current_dir(place.root())
        .output()
        .unwrap();
    assert_eq!(place.bytes("full").len(), 64 << 10);
    output
}

#[test]
fn what_cannot_be_written_to_standard_output_is_exit_code_2() {
    let place = Workplace::new();
    place.run("run small.toml --out a --quiet");
    let model = Workplace::project_file("fixtures/classifier.model");
    for words in [
        format!("classify {model} a/frames.rdm"),
        "inspect a/frames.cube".to_owned(),
        "cache --cache cache".to_owned(),
        "run small.toml --cache cache --dry-run --quiet".to_owned(),
        "run small.toml --cache cache --quiet --explain --out b".to_owned(),
        "dsp a/frames.cube --quiet --out c".to_owned(),
        "rcs corner.obj --freq-ghz 77 --az-deg 0 --quiet --out s.npy".to_owned(),
        "--help".to_owned(),
        "rcs --help".to_owned(),
        "--version".to_owned(),
    ] {
        let output = on_full_file(&place, &words, "1");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{words}: {said}");
        assert!(said.contains("standard output"), "{words}: {said}");
    }
    let left: Vec<_> =
        ["b", "c"].iter().flat_map(|folder| names(&place, folder)).filter(|n| n.contains("part")).collect();
    assert!(left.is_empty(), "{left:?}");
    for whole in ["b/frames.points", "c/frames.points"] {
        assert!(!place.path(whole).exists(), "{whole}: the work went on after its first line was lost");
    }
}

fn names(place: &Workplace, folder: &str) -> Vec<String> {
    let entries = std::fs::read_dir(place.path(folder)).into_iter().flatten().flatten();
    entries.map(|entry| entry.file_name().into_string().unwrap()).collect()
}

#[test]
fn a_reader_that_has_gone_away_ends_the_program_quietly_and_leaves_no_temporary_file() {
    let place = Workplace::new();
    place.run("echo small.toml --out a.cube --quiet");
    for words in ["inspect a.cube", "dsp a.cube --quiet --out d", "cache", "--help"] {
        let mut child = place.command(words).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{words}");
        assert!(output.stderr.is_empty(), "{words}: {}", String::from_utf8_lossy(&output.stderr));
    }
    assert!(names(&place, "d").iter().all(|name| !name.contains("part")), "{:?}", names(&place, "d"));
}

#[test]
fn remarks_that_nobody_can_read_are_not_missed() {
    let place = Workplace::new();
    for (words, code) in
        [("paths small.toml --out a.paths", 0), ("inspect nothing.cube", 2), ("echo a.paths --out b", 1)]
    {
        let output = on_full_file(&place, words, "2");
        assert_eq!(output.status.code(), Some(code), "{words}");
        let mut child = place.command(words).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stderr.take());
        assert_eq!(child.wait().unwrap().code(), Some(code), "{words}");
    }
}

/// Results of `run` are files: they are all there, though nobody read what it said.
#[test]
fn a_run_whose_reader_has_gone_away_is_carried_to_its_end() {
    let place = Workplace::new();
    let words = "run small.toml --out a --no-cache --explain --quiet";
    let mut child = place.command(words).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(place.summary("a/summary.json")["frames"].as_array().unwrap().len(), 2);
    assert!(place.bytes("a/report.html").ends_with(b"</html>"));
}
