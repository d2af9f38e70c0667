//! Continuity of the field of a moving car from chirp to chirp.

use super::bodies::own;
use crate::study::extent::Extent;
use crate::study::pages::measures::references::continuity::{self, Named, Slide};
use crate::study::pages::measures::references::methods::{bart, po, sbr};
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{SCATTERING, SourcePaths};
use wayside::host::failure::Failure;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[
    SCATTERING,
    &[
        "crates/wayside/tests/bart_against_references/continuity.rs",
        "crates/wayside/tests/bart_against_references/methods.rs",
        file!(),
    ],
];

pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let mesh = own("car-suv")?;
    let slide = Slide {
        mesh: &mesh,
        antenna_m: glam::DVec3::new(27.0, 12.0, 5.0),
        velocity_mps: glam::DVec3::new(10.0, 0.0, 0.0),
        frequency_hz: 10e9,
        chirp_interval_s: 60e-6,
        chirps: if extent == Extent::Quick { 4 } else { 32 },
    };
    let methods = methods();
    let methods = if extent == Extent::Quick { &methods[..1] } else { &methods };
    let mut part = PageSection::default();
    part.head(&["method", "increment, rad", "floor, dB"]);
    for (name, error_rad, floor_db) in continuity::rows(&slide, methods) {
        let error = if error_rad == 0.0 { "reference".to_owned() } else { format!("{error_rad:.1e}") };
        part.line(format!("| {name} | {error} | {} |", format!("{floor_db:.1}").replace('-', "−")));
    }
    Ok(part)
}

fn methods() -> [Named<'static>; 6] {
    [
        ("BART, three bounces, −20 dB asked", 3, Box::new(|m, p, f| bart(m, p, f, 3, -20.0))),
        ("BART, three bounces, −40 dB asked", 3, Box::new(|m, p, f| bart(m, p, f, 3, -40.0))),
        ("po, one bounce, 2 cells per λ, borders not halved", 1, Box::new(|m, p, f| po(m, p, f, 2.0, 0))),
        ("po, one bounce, 2 cells per λ, borders halved 3 times", 1, Box::new(|m, p, f| po(m, p, f, 2.0, 3))),
        ("sbr, three bounces, 1 ray per λ", 3, Box::new(|m, p, f| sbr(m, p, f, 1.0, 3))),
        ("sbr, three bounces, 4 rays per λ", 3, Box::new(|m, p, f| sbr(m, p, f, 4.0, 3))),
    ]
}
