//! Elements with errors, before and after calibration.

use crate::study::extent::Extent;
use crate::study::pages::measures::signals::common::{elements_3x4, elements_12x16};
use crate::study::pages::measures::signals::erring_elements::compared;
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{SIGNALS, SourcePaths};
use wayside::host::failure::Failure;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths =
    &[SIGNALS, &["crates/dsp/tests/direction/erring_elements.rs", file!()]];

pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    part.head(&["array", "elements", "points", "direction, beams", "sidelobe, dB"]);
    for (name, elements, draws) in [("3 × 4", elements_3x4(), 400), ("12 × 16", elements_12x16(), 24)] {
        let draws = extent.case_count(draws);
        let cases = compared(elements, draws);
        for (what, [beams, sidelobe_db]) in ["ideal", "3 dB, 30°", "calibrated"].into_iter().zip(cases) {
            let points = 5 * draws;
            part.line(format!("| {name} | {what} | {points} | {beams:.4} | {sidelobe_db:.1} |"));
        }
    }
    Ok(part)
}
