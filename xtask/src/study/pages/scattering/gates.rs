//! Figures compared with the gates of reference data that no code of the project made.

use crate::project::shared;
use crate::study::extent::Extent;
use crate::study::pages::measures::gates::{CHECKS, Row};
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{SCATTERING, SourcePaths};
use wayside::host::failure::Failure;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths =
    &[SCATTERING, &["crates/wayside/tests/reference_gates/gates", file!()]];

pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let folder = shared().join("reference");
    if !folder.is_dir() {
        return Err(Failure::System(format!("{}: the reference data is not here", folder.display())));
    }
    let mut part = PageSection::default();
    let checks = if extent == Extent::Quick { &CHECKS[..1] } else { &CHECKS };
    let mut missed = 0;
    for (heading, check) in checks {
        part.line(format!("\n## {heading}\n\n| check | figure | gate | |\n|---|---|---|---|"));
        let rows = check(&folder);
        rows.iter().for_each(|row| part.line(row.line()));
        missed += rows.iter().filter(|row| !Row::holds(row)).count();
    }
    if missed > 0 {
        part.complain(format!("{missed} figures are outside their gates"));
    }
    Ok(part)
}
