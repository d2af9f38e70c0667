//! Velocities beyond the span of either chirp interval, resolved by two intervals.

use crate::study::extent::Extent;
use crate::study::pages::measures::signals::fold_trials::{isolated_is_right, pair, vehicles_right};
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{SIGNALS, SourcePaths};
use rayon::prelude::*;
use wayside::host::failure::Failure;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[SIGNALS, &["crates/dsp/tests/estimation/fold_trials.rs", file!()]];

/// Name, samples, idle time of the second sub-frame, lone points.
const WAVEFORMS: [(&str, u32, f64, u64); 2] =
    [("experiment 1, 60 and 75 µs", 256, 25e-6, 3000), ("experiment 3, 110 and 137 µs", 512, 37e-6, 1500)];

pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    part.head(&["waveform", "targets", "number", "right", "certain and wrong"]);
    for (name, samples, idle_s, points) in WAVEFORMS {
        let headers = pair(samples, 64, idle_s);
        let points = extent.case_count(points);
        let isolated = (0..points).into_par_iter().filter(|seed| isolated_is_right(&headers, *seed)).count();
        row(&mut part, [name, "lone points"], isolated, points, None);
        let trials = extent.case_count(300);
        for (what, count) in [("vehicles", 1), ("vehicles, two in the same range cells", 2)] {
            let [right, wrong] = all_of(trials, &|seed| vehicles_right(&headers, count, seed));
            row(&mut part, [name, what], right, count as u64 * trials, Some(wrong));
        }
    }
    Ok(part)
}

/// Sums over the given number of draws.
pub(super) fn all_of(trials: u64, right: &(dyn Fn(u64) -> [usize; 2] + Sync)) -> [usize; 2] {
    let all: Vec<[usize; 2]> = (1000..1000 + trials).into_par_iter().map(right).collect();
    [0, 1].map(|i: usize| all.iter().map(|trial| trial[i]).sum::<usize>())
}

/// Adds a row: the share of right ones, and the number of certain but wrong ones if counted.
pub(super) fn row(part: &mut PageSection, names: [&str; 2], right: usize, all: u64, wrong: Option<usize>) {
    let [name, what] = names.map(str::to_owned);
    let share = format!("{:.2} %", 100.0 * right as f64 / all as f64);
    part.row(&[name, what, all.to_string(), share, wrong.map_or("–".to_owned(), |n| n.to_string())]);
}
