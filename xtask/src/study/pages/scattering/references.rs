//! BART against dense sampling and rays of increasing density, order by order, at 77 GHz.

use super::bodies::{own, real};
use crate::study::extent::Extent;
use crate::study::pages::measures::references::methods::{Run, bart, decibels, error, po, sbr};
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{SCATTERING, SourcePaths};
use artifact::scene::Mesh;
use bart_rcs::Standpoint;
use num_complex::Complex64;
use wayside::host::failure::Failure;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths =
    &[SCATTERING, &["crates/wayside/tests/bart_against_references/methods.rs", file!()]];

fn standpoint(az_deg: f64, el_deg: f64) -> Standpoint {
    Standpoint { azimuth_rad: az_deg.to_radians(), elevation_rad: el_deg.to_radians(), range_m: 30.0 }
}

/// The project's SUV.
pub(crate) fn own_car(extent: Extent) -> Result<PageSection, Failure> {
    let (mesh, place, frequencies_hz) = (own("car-suv")?, standpoint(25.0, 10.0), [77.3125e9, 77.9375e9]);
    let exact = bart(&mesh, place, &frequencies_hz, 3, -60.0);
    let mut part = PageSection::default();
    part.head(&["method", "seconds", "order 1", "order 2", "order 3"]);
    let mut row = |run: &Run| {
        let errors = [0, 1, 2].map(|order| order_error(run, &exact, order));
        part.line(format!("| {} | {:.1} | {} |", run.name, run.seconds, errors.join(" | ")));
    };
    [-20.0, -40.0].iter().for_each(|db| row(&bart(&mesh, place, &frequencies_hz, 3, *db)));
    let (cells, rays) = match extent {
        Extent::Quick => (&[][..], &[0.5][..]),
        Extent::Full => (&[(1.0, 0), (1.0, 4)][..], &[0.5, 1.0, 2.0, 4.0][..]),
    };
    cells.iter().for_each(|(density, halved)| row(&po(&mesh, place, &frequencies_hz, *density, *halved)));
    rays.iter().for_each(|density| row(&sbr(&mesh, place, &frequencies_hz, *density, 3)));
    Ok(part)
}

/// The car `gazebo_prius`, with large flat facets.
pub(crate) fn real_car(extent: Extent) -> Result<PageSection, Failure> {
    at_four_aspects(&real("gazebo_prius")?, extent)
}

/// The car `modern_hatchback`, with five times as many facets.
pub(crate) fn second_real_car(extent: Extent) -> Result<PageSection, Failure> {
    at_four_aspects(&real("modern_hatchback")?, extent)
}

/// Densities of the references: cells per wavelength with the number of halvings of borders, and rays.
type Densities = (&'static [(f64, u32)], &'static [f64]);

/// Both references with increasing density, against BART, and rays against rays.
fn at_four_aspects(mesh: &Mesh, extent: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    let columns = ["azimuth", "method", "processor seconds", "order 1", "order 2", "order 3"];
    part.head(&[columns.as_slice(), &["orders 2 and 3"]].concat());
    let (azimuths_deg, densities): (&[f64], Densities) = match extent {
        Extent::Quick => (&[90.0], (&[], &[0.5, 1.0])),
        Extent::Full => {
            (&[0.0, 30.0, 90.0, 180.0], (&[(1.0, 0), (1.0, 6), (2.0, 6)], &[2.0, 4.0, 8.0, 16.0]))
        }
    };
    azimuths_deg.iter().for_each(|az_deg| at_aspect(&mut part, mesh, *az_deg, densities));
    Ok(part)
}

fn at_aspect(part: &mut PageSection, mesh: &Mesh, az_deg: f64, (cells, rays): Densities) {
    let (place, frequencies_hz) = (standpoint(az_deg, 8.0), [76.5e9, 76.83e9, 77.17e9, 77.5e9]);
    let exact = bart(mesh, place, &frequencies_hz, 3, -60.0);
    let mut row = |method: &str, seconds: &str, errors: &[String]| {
        part.line(format!("| {az_deg}° | {method} | {seconds} | {} |", errors.join(" | ")));
    };
    let level = |order: &Vec<Complex64>| ratio_text(size(order) / size(&exact.orders[0]));
    let levels: Vec<String> = exact.orders.iter().map(level).chain([String::new()]).collect();
    row("(level over order 1)", "", &levels);
    let seconds = |run: &Run| format!("{:.1}", run.seconds);
    let ours = bart(mesh, place, &frequencies_hz, 3, -20.0);
    let sampled = cells.iter().map(|(density, halved)| po(mesh, place, &frequencies_hz, *density, *halved));
    std::iter::once(ours)
        .chain(sampled)
        .for_each(|run| row(&run.name, &seconds(&run), &all_errors(&run, &exact)));
    let mut before: Option<Run> = None;
    for density in rays {
        let run = sbr(mesh, place, &frequencies_hz, *density, 3);
        row(&run.name, &seconds(&run), &all_errors(&run, &exact));
        if let Some(coarser) = before.replace(run) {
            before.iter().for_each(|finer| {
                row("rays of half that density against these", "", &all_errors(&coarser, finer));
            });
        }
    }
}

fn size(s: &[Complex64]) -> f64 {
    s.iter().map(|s| s.norm_sqr()).sum::<f64>().sqrt()
}

/// Text of a ratio in dB; "nothing" if it is not positive and finite.
fn ratio_text(ratio: f64) -> String {
    if ratio > 0.0 && ratio.is_finite() {
        format!("{:.1} dB", decibels(ratio)).replace('-', "−")
    } else {
        "nothing".to_owned()
    }
}

fn order_error(run: &Run, reference: &Run, order: usize) -> String {
    run.orders.get(order).map_or("–".to_owned(), |s| ratio_text(error(s, &reference.orders[order])))
}

/// Errors of orders 1, 2 and 3 separately, and of orders 2 and 3 together.
fn all_errors(run: &Run, reference: &Run) -> [String; 4] {
    let both = |run: &Run| run.orders[1].iter().zip(&run.orders[2]).map(|(a, b)| a + b).collect::<Vec<_>>();
    let together =
        if run.orders.len() < 3 { "–".to_owned() } else { ratio_text(error(&both(run), &both(reference))) };
    let [first, second, third] = [0, 1, 2].map(|order| order_error(run, reference, order));
    [first, second, third, together]
}
