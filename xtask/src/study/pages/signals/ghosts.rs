//! Waves between two bodies, and several direct echoes in a cell: the share marked as ghosts.

use crate::study::extent::Extent;
use crate::study::pages::measures::signals::common::{elements_3x4, elements_6x8, elements_12x16};
use crate::study::pages::measures::signals::ghost_cells::{Site, direct, ghost, marked};
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{SIGNALS, SourcePaths};
use wayside::host::failure::Failure;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[SIGNALS, &["crates/dsp/tests/direction/ghost_cells.rs", file!()]];

pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    for (name, elements, trials) in
        [("3 × 4", elements_3x4(), 1000), ("6 × 8", elements_6x8(), 300), ("12 × 16", elements_12x16(), 40)]
    {
        let (mut site, trials) = (Site::new(elements, 5), extent.case_count(trials) as u32);
        part.line(format!("## {name}, beams of {:.3}\n", site.array.beams()[0]));
        of_ghosts(&mut part, &mut site, trials);
        of_direct_echoes(&mut part, &mut site, trials);
    }
    Ok(part)
}

fn of_ghosts(part: &mut PageSection, site: &mut Site, trials: u32) {
    part.head(&["dB a channel", "0.5", "0.7", "1", "2", "4"]);
    for snr_db in [-5.0, 0.0, 5.0, 10.0, 20.0, 30.0] {
        let share = |beams: f64| {
            let cell = |site: &mut Site| {
                let (values, range_m, _) = ghost(site, snr_db, beams);
                (values, range_m)
            };
            format!("{:.0} %", 100.0 * marked(site, trials, cell))
        };
        part.line(format!("| {snr_db} | {} |", [0.5, 0.7, 1.0, 2.0, 4.0].map(share).join(" | ")));
    }
    part.line("");
}

fn of_direct_echoes(part: &mut PageSection, site: &mut Site, trials: u32) {
    part.head(&["direct echoes:", "1", "2", "3", "8", "20"]);
    for across_m in [1.0, 2.0, 8.0] {
        let share = |echoes: usize| {
            format!("{:.1} %", 100.0 * marked(site, trials, |site| direct(site, echoes, 20.0, across_m)))
        };
        part.line(format!("| {across_m} m | {} |", [1, 2, 3, 8, 20].map(share).join(" | ")));
    }
    part.line("");
}
