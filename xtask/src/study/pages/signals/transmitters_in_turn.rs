//! Velocity folds resolved by the phases between transmitters of time division.

use super::ambiguity::{all_of, row};
use crate::study::extent::Extent;
use crate::study::pages::measures::signals::common::{Target, elements_3x4, elements_6x8, elements_12x16};
use crate::study::pages::measures::signals::fold_trials::{
    folds_of_points, in_turn, in_turn_twice, isolated_is_right, right_of, seen_once, vehicles, vehicles_right,
};
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{SIGNALS, SourcePaths};
use artifact::cube::CubeHeader;
use dsp::angle::Direction;
use dsp::least_loss;
use rayon::prelude::*;
use wayside::host::failure::Failure;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[SIGNALS, &["crates/dsp/tests/estimation/fold_trials.rs", file!()]];

pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    arrays(&mut part, extent);
    part.line("");
    by_vehicles(&mut part, extent);
    Ok(part)
}

/// Transmit and receive elements in half wavelengths.
type Elements = [Vec<[f64; 2]>; 2];

/// Names, elements, lone points.
fn all() -> [(&'static str, Elements, u64); 7] {
    let row = |places: &[f64]| places.iter().map(|p| [*p, 0.0]).collect::<Vec<_>>();
    let four = || row(&[0.0, 1.0, 2.0, 3.0]);
    [
        ("2x4: 0, 4", [row(&[0.0, 4.0]), four()], 300),
        ("3x4: 0, 4, 8", elements_3x4(), 1000),
        ("3x4, one overlapping: 0, 3, 6", [row(&[0.0, 3.0, 6.0]), four()], 300),
        (
            "3x4, wide receivers: 0, 1, 2 by 0, 3, 6, 9",
            [row(&[0.0, 1.0, 2.0]), row(&[0.0, 3.0, 6.0, 9.0])],
            300,
        ),
        ("6x8 with elevation", elements_6x8(), 300),
        ("12x16", elements_12x16(), 40),
        ("4x1: 0, 1, 2, 3", [four(), row(&[0.0])], 300),
    ]
}

/// Adds a row for each array: the loss of a wrong fold, and the folds found for single points.
fn arrays(part: &mut PageSection, extent: Extent) {
    part.head(&[
        "array: transmitters by receivers, λ/2",
        "a wrong fold loses",
        "found",
        "right",
        "certain",
        "certain and wrong",
    ]);
    let directions: Vec<Direction> =
        (-10..=10).map(|i| Direction { right: 0.05 * f64::from(i), up: None }).collect();
    for (name, elements, trials) in all() {
        let mut header = in_turn(elements);
        let slots = header.radar.array.tx_m.len() as u32;
        header.radar.waveform.chirps = (192 / slots).max(32);
        let lost = least_loss(&header, &directions, 40.0);
        let [found, certain, right, certain_right] = folds_of_points(&header, extent.case_count(trials));
        let share = |n: usize| format!("{:.2} %", 100.0 * n as f64 / found as f64);
        part.row(&[
            name.to_owned(),
            format!("{:.1} %", 100.0 * lost),
            found.to_string(),
            share(right),
            share(certain),
            (certain - certain_right).to_string(),
        ]);
    }
}

const OF_VEHICLES: [(&str, usize); 2] = [("vehicles", 1), ("vehicles, two in the same range cells", 2)];

fn by_vehicles(part: &mut PageSection, extent: Extent) {
    part.head(&["array", "targets", "number", "right", "certain and wrong"]);
    let trials = extent.case_count(60);
    for (name, elements) in [("3x4, 29 µs", elements_3x4()), ("6x8, 29 µs", elements_6x8())] {
        let header = in_turn(elements);
        for (what, count) in OF_VEHICLES {
            let [right, wrong] = all_of(trials, &|seed| folds_of_vehicles(&header, count, seed));
            row(part, [name, what], right, count as u64 * trials, Some(wrong));
        }
    }
    let (name, headers, points) = ("3x4, 60 and 75 µs", in_turn_twice(), extent.case_count(500));
    let lone = (0..points).into_par_iter().filter(|seed| isolated_is_right(&headers, *seed)).count();
    row(part, [name, "lone points"], lone, points, None);
    for (what, count) in OF_VEHICLES {
        let [right, wrong] = all_of(trials, &|seed| vehicles_right(&headers, count, seed));
        row(part, [name, what], right, count as u64 * trials, Some(wrong));
    }
}

/// Folds of vehicles side by side, by time division alone: numbers of right ones, and of certain but wrong
/// ones.
fn folds_of_vehicles(header: &CubeHeader, count: usize, seed: u64) -> [usize; 2] {
    let vehicles = vehicles(header, count, seed);
    let targets: Vec<Target> = vehicles.iter().flat_map(|v| v.0.clone()).collect();
    right_of(&seen_once(header, &targets, seed), &vehicles)
}
