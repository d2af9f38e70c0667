//! Atlas of the failures of each method: small cases with known answers, and a verdict on the program's
//! statement about each.

mod verdict;
mod methods;
mod scattering;
mod echo;
mod signals;
mod traffic;
mod learning;
mod refusals;
mod coverage;
mod presentation;
mod picture;

pub(super) use picture::{COLUMNS, picture};
pub(super) use presentation::{count, csv, page};
pub(super) use verdict::{CaseRow, ErrorStatement, Verdict};

use crate::study::extent::Extent;
use std::time::Instant;
use verdict::AtlasCase;
use wayside::host::failure::Failure;
use wayside::host::progress::Work;
use wayside::program::terminal;

/// Every row, theme by theme; with a word only those of the cases whose names contain it.
pub(super) fn rows(extent: Extent, only: Option<&str>) -> Result<Vec<CaseRow>, Failure> {
    let work = Work::begin("atlas");
    let themes =
        [refusals::CASES, scattering::CASES, traffic::CASES, echo::CASES, signals::CASES, learning::CASES];
    let is_asked = |case: &&AtlasCase| only.is_none_or(|word| case.name.contains(word));
    let cases: Vec<&AtlasCase> = themes.into_iter().flatten().filter(is_asked).collect();
    if let (Some(word), true) = (only, cases.is_empty()) {
        return Err(Failure::System(format!("atlas: --only {word}: no case has that in its name")));
    }
    let mut all = Vec::new();
    for (number, case) in cases.iter().enumerate() {
        work.at(number, cases.len());
        let started = Instant::now();
        let rows = (case.rows)(extent)?;
        log(case.name, started, &rows);
        all.extend(rows);
    }
    let missing = coverage::missing(&all);
    match only {
        None if !missing.is_empty() => Err(Failure::Refused(format!("atlas: no case is called {missing:?}"))),
        _ => Ok(all),
    }
}

/// Prints a case as soon as it was tried, because the page takes minutes.
fn log(name: &str, started: Instant, rows: &[CaseRow]) {
    let counts = Verdict::ALL.map(|v| format!("{} {}", count(rows, v), v.name()));
    let seconds = started.elapsed().as_secs_f64();
    terminal::line(format!("{name:<40}{seconds:>7.1} s  {}", counts.join(", ")));
}
