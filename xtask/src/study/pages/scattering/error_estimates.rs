//! Printed and true errors in random cases.

use super::bodies::{Named, all, all_own, experiment_1};
use super::frames::try_frame;
use super::roads::try_road;
use crate::study::extent::Extent;
use crate::study::pages::measures::references::random_cases::try_case;
use crate::study::pages::measures::references::random_tables::try_table;
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{SCATTERING, SourcePaths};
use wayside::host::failure::Failure;
use wayside::host::progress::Work;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[
    SCATTERING,
    &[
        "crates/wayside/tests/bart_against_references/methods.rs",
        "crates/wayside/tests/bart_against_references/random_cases.rs",
        "crates/wayside/tests/bart_against_references/random_tables.rs",
        "xtask/src/study/pages/scattering/frames.rs",
        "xtask/src/study/pages/scattering/roads.rs",
        file!(),
    ],
];

/// Printed and true errors of S, the complex scattering amplitude, at one aspect.
pub(crate) fn of_aspects(extent: Extent) -> Result<PageSection, Failure> {
    let meshes = all()?;
    let columns = [
        "vehicle",
        "azimuth, °",
        "elevation, °",
        "range, m",
        "bounces",
        "asked, dB",
        "printed, dB",
        "true, dB",
    ];
    let table = coverage_table(&columns, extent.case_count(100), &|case| {
        let found = try_case(case, &meshes, [76e9, 81e9]);
        Ok((found.to_string(), [found.printed_db, found.true_db]))
    })?;
    Ok(require_coverage(table))
}

/// Printed and true errors of tables of several aspects, with every choice of `rcs`.
pub(crate) fn of_tables(extent: Extent) -> Result<PageSection, Failure> {
    let meshes = all()?;
    let columns = [
        "vehicle",
        "GHz",
        "azimuths, °",
        "elevation, °",
        "range, m",
        "receiver: az, el, range",
        "choices",
        "bounces",
        "asked, dB",
        "printed, dB",
        "true, dB",
    ];
    let table = coverage_table(&columns, extent.case_count(50), &|case| {
        let found = try_table(case, &meshes, &[24e9, 60e9, 77e9]);
        Ok((found.to_string(), [found.printed_db, found.true_db]))
    })?;
    Ok(require_coverage(table))
}

/// Printed and true errors of a frame's map.
pub(crate) fn of_frames(extent: Extent) -> Result<PageSection, Failure> {
    let (meshes, header) = (all()?, experiment_1()?);
    let columns = ["vehicle", "x, y, m", "heading, °", "speed, m/s", "bounces", "asked, dB", "paths"];
    let table = coverage_table(
        &[&columns, ["printed, dB", "true, dB"].as_slice()].concat(),
        extent.case_count(100),
        &|case| {
            let found = try_frame(case, &meshes, &header)?;
            Ok((found.to_string(), [found.printed_db, found.true_db]))
        },
    )?;
    Ok(require_coverage(table))
}

/// Printed and true errors of leaving the road out: the figure is for dry asphalt, and the roads are not; the
/// number of covered cases is measured, not promised.
pub(crate) fn of_roads(extent: Extent) -> Result<PageSection, Failure> {
    let (meshes, header): (Vec<Named>, _) = (all_own()?, experiment_1()?);
    let columns =
        ["vehicle", "range, m", "heading, °", "height, m", "bounces", "road", "printed, dB", "true, dB"];
    let table = coverage_table(&columns, extent.case_count(19), &|case| {
        let found = try_road(case, &meshes, &header)?;
        Ok((found.to_string(), [found.printed_db, found.true_db]))
    })?;
    Ok(table.part)
}

/// A table with the outcomes of its cases.
struct CoverageTable {
    part: PageSection,
    inside: usize,
    of: usize,
    median_db: f64,
}

/// A row for each case; finally the number of true errors below the printed ones.
fn coverage_table(
    columns: &[&str],
    cases: u64,
    row: &dyn Fn(u64) -> Result<(String, [f64; 2]), Failure>,
) -> Result<CoverageTable, Failure> {
    let work = Work::begin("cases");
    let (mut part, mut excess_db) = (PageSection::default(), Vec::new());
    part.head(&[columns, &["excess, dB"]].concat());
    for case in 0..cases {
        work.at(case as usize, cases as usize);
        let (line, [printed_db, true_db]) = row(case)?;
        part.line(line);
        excess_db.push(printed_db - true_db);
    }
    excess_db.sort_by(f64::total_cmp);
    let (inside, of) = (excess_db.iter().filter(|excess| **excess >= 0.0).count(), excess_db.len());
    let median_db = excess_db[of / 2];
    let (least, greatest) = (excess_db[0], excess_db[of - 1]);
    part.line(format!(
        "\n**{inside} of {of} inside; median excess {median_db:.1} dB** (least {least:.1}, greatest {greatest:.1})."
    ));
    Ok(CoverageTable { part, inside, of, median_db })
}

/// Judges the outcomes: 95 of 100 are required, and the others not far outside.
fn require_coverage(table: CoverageTable) -> PageSection {
    let CoverageTable { mut part, inside, of, median_db } = table;
    if 100 * inside < 95 * of || median_db > 10.0 {
        part.complain(format!("{inside} of {of} inside, median excess {median_db:.1} dB"));
    }
    part
}
