//! Gates of the reference data beside the checkout (`../shared/reference`): measurements, exact and full-wave
//! solutions that no code of the project made. Without that folder every test says so and passes.
//!
//! Each check yields rows of figure beside gate; `cargo xtask study reference-gates` writes them to
//! `docs/validation/reference-gates.md`.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

mod gates;

use gates::{Check, Row, austin, closed_form, corners, edges, full_wave};
use std::path::PathBuf;

/// `../shared/reference`, or `None` with a word about it.
fn reference_folder() -> Option<PathBuf> {
    let shared =
        std::env::var("WAYSIDE_SHARED").unwrap_or(format!("{}/../../../shared", env!("CARGO_MANIFEST_DIR")));
    let folder = PathBuf::from(shared).join("reference");
    let found = folder.is_dir().then_some(folder);
    if found.is_none() {
        println!("skipped: ../shared is not here");
    }
    found
}

fn hold(check: Check) {
    let Some(folder) = reference_folder() else { return };
    let rows = check(&folder);
    rows.iter().for_each(|row| println!("{}", row.line()));
    let broken: Vec<String> = rows.iter().filter(|row| !row.holds()).map(Row::line).collect();
    assert!(broken.is_empty(), "outside their gates:\n{}", broken.join("\n"));
}

#[test]
fn first_order_lands_on_the_closed_forms() {
    hold(closed_form::rows);
}

#[test]
fn first_order_has_the_known_error_of_physical_optics_on_measured_bodies() {
    hold(austin::rows);
}

#[test]
fn edges_come_nearer_to_exact_and_full_wave_solutions_than_their_gates() {
    hold(edges::rows);
}

#[test]
fn corner_reflectors_have_their_levels_and_signs() {
    hold(corners::rows);
}

#[test]
fn multiple_bounces_come_as_near_to_full_wave_solutions_as_geometrical_optics_does() {
    hold(full_wave::rows);
}
