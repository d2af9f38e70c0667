//! Cases of every reader in all fuzz runs, by the ledger of their logs.

use crate::fuzz_ledger;
use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use crate::study::sources::SourcePaths;
use wayside::host::failure::Failure;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[&["fixtures/fuzz.csv", "xtask/src/fuzz_ledger.rs", file!()]];

/// Makes the part; the ledger is one, whatever the extent.
pub(crate) fn section(_: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    part.line(fuzz_ledger::table()?.trim_end());
    Ok(part)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::project_root;
    use crate::study::page::part_of;

    #[test]
    fn the_table_of_the_page_is_that_of_the_ledger() {
        let page = std::fs::read_to_string(project_root().join("docs/validation/fuzz.md")).unwrap();
        let told = part_of(&page, "fuzz").unwrap();
        assert!(told == fuzz_ledger::table().unwrap().trim(), "cargo xtask study fuzz makes it anew");
    }
}
