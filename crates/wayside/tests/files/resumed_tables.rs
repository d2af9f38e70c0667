//! `rcs`: a table that is interrupted goes on where it was, and is the same to the byte.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::{PROGRAM, Workplace};
use serde_json::Value;
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// Three plates that meet at right angles, each in 2 × 6 × 6 triangles: a table of a few hundredths of a
/// second an aspect.
fn cut_corner() -> String {
    const CUTS: usize = 6;
    let mut text = String::new();
    let mut corners = 0;
    for plate in 0..3 {
        for (i, j) in (0..CUTS).flat_map(|i| (0..CUTS).map(move |j| (i, j))) {
            for (u, v) in [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)] {
                let mut at = [0.0; 3];
                at[plate] = 0.5 * u as f64 / CUTS as f64;
                at[(plate + 1) % 3] = 0.5 * v as f64 / CUTS as f64;
                text.push_str(&format!("v {} {} {}\n", at[0], at[1], at[2]));
            }
            text.push_str(&format!("f {} {} {} {}\n", corners + 1, corners + 2, corners + 3, corners + 4));
            corners += 4;
        }
    }
    text
}

const WORDS: &str =
    "rcs cut.obj --freq-ghz 76:78:8 --az-deg 0:90:80 --el-deg 20 --accuracy-db -20 --quiet --out";

fn workplace() -> Workplace {
    let place = Workplace::new();
    std::fs::write(place.path("cut.obj"), cut_corner()).unwrap();
    place
}

/// A run that has kept some aspects of 80.
fn begun(place: &Workplace, words: &str, checkpoint: &str) -> Child {
    let mut child = place.command(words).spawn().unwrap();
    let kept = || std::fs::metadata(place.path(checkpoint)).map_or(0, |about| about.len());
    while kept() < 4096 {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it could be interrupted");
        std::thread::sleep(Duration::from_millis(1));
    }
    child
}

/// `S.json` without what may differ between runs.
fn described(place: &Workplace, name: &str) -> Value {
    let mut json = place.summary(name);
    for key in ["seconds", "cached", "peak_memory_mib"] {
        assert!(json.as_object_mut().unwrap().remove(key).is_some(), "no `{key}`");
    }
    json
}

fn resumed(place: &Workplace, words: &str, whole: &str) {
    place.run(words);
    assert_eq!(place.bytes("s.npy"), place.bytes(&format!("{whole}.npy")));
    assert_eq!(described(place, "s.json"), described(place, &format!("{whole}.json")));
    let cached = place.summary("s.json")["cached"].as_u64().unwrap();
    println!("{cached} of 80 aspects were there");
    assert!((1..80).contains(&cached));
    assert!(!place.path("s.npy.checkpoint").exists());
}

#[test]
fn a_table_that_is_killed_or_interrupted_goes_on_to_the_same_bytes() {
    let place = workplace();
    place.run(&format!("{WORDS} whole.npy"));
    assert_eq!(place.summary("whole.json")["cached"], 0);
    assert!(place.summary("whole.json")["far_field_error"]["complex_db"][0].is_f64());
    let words = format!("{WORDS} s.npy");
    let mut child = begun(&place, &words, "s.npy.checkpoint");
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!place.path("s.npy").exists() && !place.path("s.json").exists());
    resumed(&place, &words, "whole");
    std::fs::remove_file(place.path("s.npy")).unwrap();
    let mut child = begun(&place, &words, "s.npy.checkpoint");
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(!place.path("s.npy").exists());
    resumed(&place, &words, "whole");
}

#[test]
fn what_was_kept_of_another_table_or_damaged_is_not_used() {
    let place = workplace();
    place.run(&format!("{WORDS} whole.npy"));
    let mut child = begun(&place, &format!("{WORDS} s.npy --nodes middle"), "s.npy.checkpoint");
    child.kill().unwrap();
    child.wait().unwrap();
    place.run(&format!("{WORDS} s.npy"));
    assert_eq!(place.bytes("s.npy"), place.bytes("whole.npy"), "another node rule's aspects");
    assert_eq!(place.summary("s.json")["cached"], 0);
    let mut child = begun(&place, &format!("{WORDS} s.npy"), "s.npy.checkpoint");
    child.kill().unwrap();
    child.wait().unwrap();
    let mut bytes = place.bytes("s.npy.checkpoint");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(place.path("s.npy.checkpoint"), bytes).unwrap();
    resumed(&place, &format!("{WORDS} s.npy"), "whole");
}

#[test]
fn a_slow_reference_goes_on_too() {
    let place = workplace();
    let words = "rcs corner.obj --freq-ghz 10 --az-deg 0:90:80 --method po --density 2 --quiet --out";
    place.run(&format!("{words} whole.npy"));
    let mut child = place.command(&format!("{words} s.npy")).spawn().unwrap();
    while std::fs::metadata(place.path("s.npy.checkpoint")).map_or(0, |about| about.len()) < 200 {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it could be killed");
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    resumed(&place, &format!("{words} s.npy"), "whole");
}

/// A command that finds the disk full where a file is to grow beyond so many KiB.
fn command_on_full_disk(place: &Workplace, words: &str, most_kib: u32) -> Command {
    let mut command = Command::new("bash");
    let script = format!("trap '' XFSZ; ulimit -f {most_kib}; exec \"$@\"");
    command
        .args(["-c", &script, "bash", PROGRAM])
        .args(words.split_whitespace().filter(|word| *word != "--quiet"))
        .current_dir(place.root());
    command
}

/// Exit code and words of a command on a full disk.
fn on_full_disk(place: &Workplace, words: &str, most_kib: u32) -> (Option<i32>, String) {
    let output = command_on_full_disk(place, words, most_kib).output().unwrap();
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Last line of a command that is interrupted as soon as it has said that its disk is full.
fn last_words_on_full_disk(place: &Workplace, words: &str, most_kib: u32) -> String {
    let mut command = command_on_full_disk(place, words, most_kib);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let mut heard = BufReader::new(child.stderr.take().unwrap());
    let mut said = String::new();
    while !said.contains("s.npy.checkpoint: ") {
        assert!(heard.read_line(&mut said).unwrap() > 0, "it ended before it could be interrupted: {said}");
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    heard.read_to_string(&mut said).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{said}");
    said.lines().last().unwrap_or_default().to_owned()
}

#[test]
fn a_table_on_a_full_disk_goes_on_from_what_was_kept_and_says_so() {
    let place = workplace();
    place.run(&format!("{WORDS} whole.npy"));
    let words = format!("{WORDS} s.npy");
    let (code, said) = on_full_disk(&place, &words, 8);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("s.npy.checkpoint: File too large"), "{said}");
    assert!(said.contains("no more is kept, the next run goes on from what it has"), "{said}");
    assert!(!said.contains("cannot be resumed") && !place.path("s.npy").exists(), "{said}");
    resumed(&place, &words, "whole");
}

#[test]
fn a_table_without_room_for_its_first_aspect_says_that_it_cannot_be_resumed_and_leaves_nothing() {
    let place = workplace();
    let (code, said) = on_full_disk(&place, &format!("{WORDS} s.npy"), 0);
    assert!(code == Some(2) && said.contains("this run cannot be resumed"), "{said}");
    assert!(!place.path("s.npy").exists() && !place.path("s.npy.checkpoint").exists(), "{said}");
}

#[test]
fn an_interrupt_on_a_full_disk_says_which_aspects_are_kept() {
    let place = workplace();
    let words = format!("{WORDS} s.npy");
    let said = last_words_on_full_disk(&place, &words, 0);
    assert_eq!(said, "interrupted; nothing is half-written, the same command begins anew");
    let said = last_words_on_full_disk(&place, &words, 8);
    assert_eq!(
        said,
        "interrupted; aspects done before a write failed are kept, the same command goes on from there"
    );
}

#[test]
fn a_table_that_ends_leaves_no_checkpoint_though_the_disk_was_too_full_for_it() {
    let place = workplace();
    let (code, said) = on_full_disk(&place, &format!("{WORDS} s.npy"), ROOM_KIB);
    assert!(code == Some(0) && said.contains("no more is kept"), "{said}");
    assert!(place.path("s.npy").exists() && !place.path("s.npy.checkpoint").exists(), "{said}");
}

/// Room for the table and its description, not for all aspects of both passes.
const ROOM_KIB: u32 = 16;
