//! Two echoes in one cell, by their distance and the noise.

use crate::study::extent::Extent;
use crate::study::pages::measures::signals::common::{elements_3x4, elements_6x8, header};
use crate::study::pages::measures::signals::pair_trials::{over_bound_db, resolved};
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{SIGNALS, SourcePaths};
use artifact::cube::CubeHeader;
use wayside::host::failure::Failure;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[SIGNALS, &["crates/dsp/tests/direction/pair_trials.rs", file!()]];

const BEAMS: [f64; 8] = [0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5];

pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    for (name, elements, axis) in [
        ("3 × 4, azimuth", elements_3x4(), 0),
        ("6 × 8, azimuth", elements_6x8(), 0),
        ("6 × 8, elevation", elements_6x8(), 1),
    ] {
        let header = header(256, 64, elements);
        part.line(format!("\n## {name}\n"));
        let columns: Vec<String> = BEAMS.map(|beams| beams.to_string()).into();
        let columns: Vec<&str> =
            std::iter::once("dB per channel").chain(columns.iter().map(String::as_str)).collect();
        part.head(&columns);
        for snr_db in [10.0, 15.0, 20.0, 30.0, 40.0] {
            let cells = BEAMS.map(|beams| cell(&header, snr_db, axis, beams, extent.case_count(250)));
            part.line(format!("| {snr_db:.0} | {} |", cells.join(" | ")));
        }
    }
    Ok(part)
}

/// Shares resolved by maximum likelihood and FFT, and the errors relative to their bound.
fn cell(header: &CubeHeader, snr_db: f64, axis: usize, beams: f64, trials: u64) -> String {
    let [ours, fft] = resolved(header, snr_db, axis, beams, trials);
    let error_db = over_bound_db(header, snr_db, axis, beams, trials);
    let error = if ours >= 0.5 { format!("{error_db:+.1} dB") } else { "–".to_owned() };
    format!("{:.0} / {:.0} %, {error}", 100.0 * ours, 100.0 * fft)
}
