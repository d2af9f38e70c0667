//! Our processing beside other programs, by the example `rivals` of `dsp`.

use crate::project::project_root;
use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{SIGNALS, SourcePaths};
use std::process::Command;
use wayside::host::failure::Failure;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths =
    &[SIGNALS, &["crates/dsp/examples/rivals", "crates/dsp/examples/rivals/rivals.py", file!()]];

/// Seconds of each program, and what is skipped where Python or a package of it is not there.
pub(crate) fn section(_: Extent) -> Result<PageSection, Failure> {
    Ok(part_of(&printed(&[])?))
}

/// False alarms of two programs.
pub(crate) fn alarms(_: Extent) -> Result<PageSection, Failure> {
    Ok(part_of(&printed(&["alarms"])?))
}

/// Lines that the example prints.
fn printed(words: &[&str]) -> Result<String, Failure> {
    let mut command = Command::new("cargo");
    command
        .args(["run", "--release", "--quiet", "--package", "dsp", "--example", "rivals", "--"])
        .args(words);
    let output = command.current_dir(project_root()).output();
    let output = output.map_err(|e| Failure::System(format!("cargo: {e}")))?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(Failure::Refused(format!("the example `rivals` of `dsp`: {said}")));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// The table, and behind it once what was skipped.
fn part_of(printed: &str) -> PageSection {
    let mut part = PageSection::default();
    printed.lines().filter(|line| line.starts_with('|')).for_each(|line| part.line(line));
    let mut skipped: Vec<&str> = printed.lines().filter_map(|line| line.strip_prefix("skipped: ")).collect();
    skipped.sort_unstable();
    skipped.dedup();
    if !skipped.is_empty() {
        part.line(format!("\nSkipped: {}.", skipped.join("; ")));
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_comes_first_and_what_is_skipped_once() {
        let printed = "skipped: NumPy is not here\n\nskipped: NumPy is not here\n| job |\n|---|\n| a |\n";
        assert_eq!(part_of(printed).finished().0, "| job |\n|---|\n| a |\n\nSkipped: NumPy is not here.\n");
    }
}
