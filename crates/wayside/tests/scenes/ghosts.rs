//! Marks of waves between two bodies against traced truth, through the whole chain.

#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::Workplace;
use crate::ghost_streets::{Counts, SCENE, counts};
use std::string::FromUtf8Error;

/// The table of points of a street, by the program in a folder of its own.
fn table_of(files: &[(String, String)]) -> Result<String, FromUtf8Error> {
    let place = Workplace::new();
    files.iter().for_each(|(name, text)| std::fs::write(place.path(name), text).unwrap());
    place.run(&format!("run {SCENE} --out out --quiet"));
    place.run("export out/frames.points --to csv --out table.csv");
    String::from_utf8(place.bytes("table.csv"))
}

/// Ghosts are counted on a small array: on larger ones a model of two points is not all there is to say of
/// plates a metre wide at 18 m; their counts are on the page.
#[test]
fn traced_waves_between_two_bodies_are_marked_and_echoes_of_one_are_not() {
    let Counts { ghosts, direct, wrong } = counts("preset = \"3x4\"", 1.0 / 6.0, 0..3, &table_of).unwrap();
    wrong.iter().for_each(|cell| println!("{cell}"));
    assert!(ghosts.all >= 20 && direct.all >= 20, "{} and {} cells are too few", ghosts.all, direct.all);
    // Between 77 and 100 % at 10 and 20 dB, one beam apart (docs/validation/ghosts.md): few cells are that
    // weak and that near. A cell between two echoes may be the other's.
    assert!(f64::from(ghosts.marked) >= 0.95 * f64::from(ghosts.all), "{} of {}", ghosts.marked, ghosts.all);
    assert!(f64::from(direct.marked) <= 0.02 * f64::from(direct.all), "{} of {}", direct.marked, direct.all);
}
