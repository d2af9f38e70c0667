//! Refined estimates against the Cramér–Rao bound, of single points and of pairs.

use crate::study::extent::Extent;
use crate::study::pages::measures::signals::bound_trials::{over_bound_db, pairs_refined, radar};
use crate::study::pages::measures::signals::common::{elements_3x4, elements_6x8, elements_12x16};
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{SIGNALS, SourcePaths};
use artifact::settings::Refine;
use wayside::host::failure::Failure;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[SIGNALS, &["crates/dsp/tests/estimation/bound_trials.rs", file!()]];

/// Number of trials, for a standard error of 0.15 dB: 4.34·√(2/n).
const TRIALS: u64 = 1600;

pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    lone_points(&mut part, extent);
    pairs(&mut part, extent);
    Ok(part)
}

fn lone_points(part: &mut PageSection, extent: Extent) {
    part.line("## A lone point\n");
    part.head(&["array", "dB per cell", "estimates", "found", "range", "velocity", "right", "up"]);
    for (name, elements, [samples, chirps], trials) in [
        ("3x4", elements_3x4(), [64, 32], TRIALS),
        ("6x8", elements_6x8(), [64, 32], TRIALS),
        ("12x16", elements_12x16(), [32, 16], TRIALS / 8),
    ] {
        for refine in [Refine::Isolated, Refine::Off] {
            let mut header = radar(elements.clone(), refine);
            (header.radar.waveform.samples, header.radar.waveform.chirps) = (samples, chirps);
            header.dsp.training_cells = [4, 6];
            for snr_db in levels_db(refine) {
                let (got_db, found) = over_bound_db(&header, *snr_db, extent.case_count(trials));
                let words = if refine == Refine::Off { "peaks" } else { "refined" };
                row(part, &format!("{name} | {snr_db:.0} | {words}"), got_db, found);
            }
        }
    }
}

fn levels_db(refine: Refine) -> &'static [f64] {
    match refine {
        Refine::Isolated => &[-5.0, 0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0],
        Refine::Off => &[10.0, 20.0, 30.0, 40.0],
    }
}

/// Distances of the second point: the varied parameter, and the values in cells of range and velocity and in
/// beams.
fn distances() -> Vec<(&'static str, Vec<[f64; 3]>)> {
    let of = |list: &[f64], place: fn(f64) -> [f64; 3]| list.iter().map(|n| place(*n)).collect();
    let near = [0.3, 0.6, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 31.0];
    vec![
        ("range", of(&near, |n| [n, 0.0, 0.0])),
        ("velocity", of(&near[..11], |n| [0.0, n, 0.0])),
        ("direction", of(&[0.3, 0.6, 1.0, 1.5, 2.0, 2.5, 3.0], |n| [0.0, 0.0, n])),
        ("range and direction", of(&[1.0, 3.0, 6.0, 12.0, 24.0, 31.0], |n| [n, 0.0, 1.5])),
        ("range and velocity", of(&[1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 24.0], |n| [n, 8.0, 0.0])),
    ]
}

fn pairs(part: &mut PageSection, extent: Extent) {
    part.line("\n## A second point beside it, of equal strength\n");
    let columns = ["apart in", "range cells", "velocity cells", "beams", "refined", "found"];
    part.head(&[columns.as_slice(), &["range", "velocity", "right", "up"]].concat());
    let header = radar(elements_3x4(), Refine::Isolated);
    for (what, places) in distances() {
        for apart in places {
            let pairs = pairs_refined(&header, 25.0, extent.case_count(TRIALS / 4), apart);
            let [cells, rows, beams] = apart;
            let line = format!("{what} | {cells} | {rows} | {beams} | {:.1} %", 100.0 * pairs.refined);
            row(part, &line, pairs.over_bound_db, pairs.found);
        }
    }
}

fn row(part: &mut PageSection, head: &str, got_db: [f64; 4], found: f64) {
    let cell = |db: f64| if db.is_finite() { format!("{db:+.2}") } else { "–".to_owned() };
    part.line(format!("| {head} | {:.1} % | {} |", 100.0 * found, got_db.map(cell).join(" | ")));
}
