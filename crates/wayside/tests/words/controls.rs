//! Controls in what users and files call things reach neither a terminal nor a page: names do not colour,
//! ring, move a cursor or begin lines.

#![allow(clippy::unwrap_used, reason = "a helper of tests fails the test")]

use crate::common::{CORNER, SMALL_SCENE, Workplace};
use artifact::scene::Scene;
use artifact::{Reader, Writer};
use std::path::Path;

/// Name with controls, and as it is shown.
const NAME: &str = "a\u{1b}[31mb\u{7}\u{9b}1m\nframe 9";
const SHOWN: &str = "a\\u{1b}[31mb\\u{7}\\u{9b}1m\\nframe 9";

/// A workplace with the small scene, the files of which have the name.
fn workplace() -> Workplace {
    let place = Workplace::new();
    let model = "a\\u001b[31mb\\u0007\\u009b1m\\nframe 9.obj";
    std::fs::write(place.path(&format!("{NAME}.toml")), SMALL_SCENE.replace("corner.obj", model)).unwrap();
    std::fs::write(place.path(&format!("{NAME}.obj")), CORNER).unwrap();
    place
}

/// Whether a text has no sign but that for a new line that a terminal would obey.
fn is_plain(text: &str) -> bool {
    !text.chars().any(|sign| sign.is_control() && sign != '\n')
}

/// What a command says on both streams, which is plain and no line of which the name begins.
fn said(place: &Workplace, words: &[&str]) -> String {
    let output = place.command("").args(words).output().unwrap();
    let streams = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert!(output.status.success(), "{words:?}: {streams:?}");
    let told = streams.concat();
    assert!(is_plain(&told) && !told.lines().any(|line| line.starts_with("frame 9")), "{words:?}: {told:?}");
    told
}

/// The scene's artifact with another name.
fn rename(from: &Path, to: &Path) {
    let reader = Reader::<Scene>::open(from).unwrap();
    let (told, mut header) = (reader.preamble().provenance.clone(), reader.header().clone());
    header.name = NAME.into();
    let mut writer = Writer::<Scene>::create(to, &told, &header).unwrap();
    reader.for_each(|frame| writer.write(&frame.unwrap()).unwrap());
    writer.finish().unwrap();
}

#[test]
fn no_name_reaches_the_terminal_with_its_controls() {
    let place = workplace();
    let scene = format!("{NAME}.toml");
    let told = said(&place, &["run", &scene, "--cache", NAME, "--out", "out", "--explain"]);
    assert!(told.contains("report: out/report.html"), "{told:?}");
    let told = said(&place, &["run", &scene, "--no-cache", "--out", "a\u{7}\n"]);
    assert!(told.contains("report: a\\u{7}\\n/report.html"), "{told:?}");
    for file in ["scene.scene", "frames.paths", "frames.cube", "frames.rdm", "frames.points"] {
        let told = said(&place, &["inspect", &format!("out/{file}")]);
        assert!(told.contains(&format!("{SHOWN}.obj")), "{told:?}");
    }
    rename(&place.path("out/scene.scene"), &place.path("named.scene"));
    let told = said(&place, &["inspect", "named.scene"]);
    assert!(told.contains(&format!("scene        {SHOWN}, seed 3")), "{told:?}");
    for words in [&["cache", "--cache", NAME][..], &["vehicles", "--out", NAME]] {
        let told = said(&place, words);
        assert!(told.contains(SHOWN), "{told:?}");
    }
}

#[test]
fn no_name_reaches_a_page_with_its_controls() {
    let place = workplace();
    said(&place, &["run", &format!("{NAME}.toml"), "--no-cache", "--out", "out", "--quiet"]);
    let page = String::from_utf8(place.bytes("out/report.html")).unwrap();
    let at = page.chars().position(|sign| sign.is_control() && !matches!(sign, '\n' | '\t'));
    assert_eq!(at, None, "a control stands on the page");
    assert!(page.contains(&SHOWN[..SHOWN.len() - "\\nframe 9".len()]), "the name is shown");
}
