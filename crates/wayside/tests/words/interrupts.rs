//! Ctrl-C and SIGTERM: the code, and whether the words tell what the same command finds done.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::{SMALL_SCENE, Workplace};
use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};

/// Last line that a command says which gets a signal as soon as it has said what it does.
fn last_words(place: &Workplace, words: &str, signal: &str) -> String {
    let mut child = place.command(words).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let mut heard = BufReader::new(child.stderr.take().unwrap());
    let mut said = String::new();
    heard.read_line(&mut said).unwrap();
    assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
    heard.read_to_string(&mut said).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{words}: {said}");
    said.lines().last().unwrap_or_default().to_owned()
}

#[test]
fn a_command_that_is_interrupted_says_what_the_next_one_finds_done() {
    let place = Workplace::new();
    std::fs::write(place.path("long.toml"), SMALL_SCENE.replace("frames = 2", "frames = 2000")).unwrap();
    let anew = "interrupted; nothing is half-written, the same command begins anew";
    for (words, signal, told) in [
        ("vehicles --count 3000 --out v", "-INT", anew),
        ("run long.toml --out o --no-cache", "-TERM", anew),
        (
            "run long.toml --out o",
            "-INT",
            "interrupted; whole frames are kept, the same command goes on from there",
        ),
    ] {
        assert_eq!(last_words(&place, words, signal), told, "{words}");
    }
}
