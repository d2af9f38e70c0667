//! Check of pages that are made by studies: every page of `docs/validation` has a study of its own, every
//! page names those that make it, and none names a missing one. Pages older than their code are reported.

use crate::ci::findings::{fail_on, pages, read};
use crate::project::project_root;
use crate::study::{Freshness, STUDIES, by_name};
use wayside::host::failure::Failure;
use wayside::program::terminal;

/// A list of pages, which no study makes.
const LIST: &str = "docs/validation/README.md";

pub(super) fn check() -> Result<(), Failure> {
    let root = project_root();
    let mut broken = Vec::new();
    for page in pages(&root) {
        let name = page.strip_prefix(&root).unwrap_or(&page).display().to_string();
        broken.extend(findings(&name, &read(&page)?));
    }
    broken.extend(freshness_of_pages()?);
    fail_on(broken)
}

/// Faults in the studies that a page names.
fn findings(name: &str, text: &str) -> Vec<String> {
    let told: Vec<&str> = named(text, "cargo xtask study ").collect();
    let own: Vec<&str> = STUDIES.iter().filter(|study| study.page == name).map(|study| study.name).collect();
    let unknown = told.iter().filter(|study| by_name(study).is_none());
    let mut found: Vec<String> =
        unknown.map(|study| format!("{name}: names the study `{study}`, which is not there")).collect();
    let untold = own.iter().filter(|study| !told.contains(study));
    found.extend(
        untold.map(|study| format!("{name}: does not name `cargo xtask study {study}`, which makes it")),
    );
    if name.starts_with("docs/validation/") && name != LIST && own.is_empty() {
        found.push(format!("{name}: no study makes it"));
    }
    found
}

/// Words in backticks or lines of programs after the given words, in lower case; without comments.
fn named<'t>(text: &'t str, before: &'static str) -> impl Iterator<Item = &'t str> {
    let prose = text.lines().filter(|line| !line.starts_with("<!--"));
    let word = |rest: &'t str| {
        rest.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-')).next().unwrap_or_default()
    };
    prose
        .flat_map(move |line| line.split(before).skip(1))
        .map(word)
        .filter(|word| word.starts_with(|c: char| c.is_ascii_lowercase()))
}

/// Studies without a place on their page; prints the number of pages older than their code.
fn freshness_of_pages() -> Result<Vec<String>, Failure> {
    let (mut missing, mut older) = (Vec::new(), Vec::new());
    for study in &STUDIES {
        match study.freshness()? {
            Freshness::Fresh => {}
            Freshness::Older | Freshness::Unknown => older.push(study.name),
            Freshness::Missing => {
                missing.push(format!("{}: has no part of the study `{}`", study.page, study.name))
            }
        }
    }
    let list = older.join(", ");
    terminal::line(format!(
        "{} of {} studies are older than their code, or of sources unknown: {list}",
        older.len(),
        STUDIES.len()
    ));
    Ok(missing)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "docs/validation/ambiguity.md";

    #[test]
    fn a_page_names_the_study_that_makes_it_and_no_other_is_enough() {
        assert!(findings(PAGE, "`cargo xtask study ambiguity` makes this.\n").is_empty());
        let untold = [format!("{PAGE}: does not name `cargo xtask study ambiguity`, which makes it")];
        for text in [
            "`cargo xtask study calibration` makes this.\n",
            "`cargo xtask dataset X.toml --out F` writes it.\n",
            "<!-- made by cargo xtask study ambiguity from sources 1 -->\n",
        ] {
            assert_eq!(findings(PAGE, text), untold, "{text}");
        }
        let alien = findings("docs/validation/a.md", "`cargo xtask study ambiguity` makes this.\n");
        assert_eq!(alien, ["docs/validation/a.md: no study makes it"]);
        assert!(findings("docs/echo.md", "`cargo xtask study ambiguity`\n").is_empty(), "no page of figures");
    }

    #[test]
    fn a_study_that_is_not_there_is_told() {
        let text = "`cargo xtask study ambiguity`, `cargo xtask study nothing`, `cargo xtask study NAME`\n";
        assert_eq!(findings(PAGE, text), [format!("{PAGE}: names the study `nothing`, which is not there")]);
    }
}
