//! Check of pages that are made by commands: every page of `docs/validation` names a study, or another
//! command that makes it, and no page names a missing study. Pages older than their code are reported.

use crate::ci::findings::{none_of, pages, read};
use crate::cli::Arguments;
use crate::project::project_root;
use crate::study::{Age, STUDIES, by_name};
use clap::CommandFactory;
use std::path::Path;
use wayside::host::failure::Failure;
use wayside::program::terminal;

/// A list of pages, which no command makes.
const LIST: &str = "docs/validation/README.md";

pub(super) fn check() -> Result<(), Failure> {
    let root = project_root();
    let mut broken = Vec::new();
    for page in pages(&root) {
        let name = page.strip_prefix(&root).unwrap_or(&page).display().to_string();
        broken.extend(findings(&root, &name, &read(&page)?));
    }
    broken.extend(ages()?);
    none_of(broken)
}

/// Faults in the commands that a page names.
fn findings(root: &Path, name: &str, text: &str) -> Vec<String> {
    let unknown = named(text, "cargo xtask study ").filter(|study| by_name(study).is_none());
    let mut found: Vec<String> =
        unknown.map(|study| format!("{name}: names the study `{study}`, which is not there")).collect();
    if name.starts_with("docs/validation/") && name != LIST && !is_made(root, text) {
        found.push(format!("{name}: names no command that makes it, such as `cargo xtask study NAME`"));
    }
    found
}

/// Whether an existing study, command of `cargo xtask` or example is named.
fn is_made(root: &Path, text: &str) -> bool {
    let commands = Arguments::command();
    let by_example = text.split("cargo run --release -p ").skip(1).any(|rest| {
        let words: Vec<&str> = rest.split(|c: char| c.is_whitespace() || c == '`').take(3).collect();
        matches!(words[..], [package, "--example", example] if has_example(root, package, example))
    });
    let mut by_command = named(text, "cargo xtask ")
        .filter(|word| *word != "study" && commands.find_subcommand(word).is_some());
    named(text, "cargo xtask study ").any(|study| by_name(study).is_some())
        || by_command.next().is_some()
        || by_example
}

fn has_example(root: &Path, package: &str, example: &str) -> bool {
    let folder = root.join("crates").join(package).join("examples");
    folder.join(format!("{example}.rs")).is_file() || folder.join(example).join("main.rs").is_file()
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
fn ages() -> Result<Vec<String>, Failure> {
    let (mut missing, mut older) = (Vec::new(), Vec::new());
    for study in &STUDIES {
        match study.age()? {
            Age::Fresh => {}
            Age::Older | Age::Unknown => older.push(study.name),
            Age::Missing => {
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

    const PAGE: &str = "docs/validation/a.md";

    fn found(text: &str) -> Vec<String> {
        findings(&project_root(), PAGE, text)
    }

    #[test]
    fn a_page_names_a_command_that_makes_it() {
        assert!(found("`cargo xtask study ambiguity` makes this.\n").is_empty());
        assert!(found("`cargo xtask dataset X.toml --out F` writes it.\n").is_empty());
        assert!(found("`cargo run --release -p dsp --example rivals`\n").is_empty());
        assert_eq!(found("`cargo xtask nothing` makes this.\n").len(), 1);
        assert_eq!(found("<!-- made by cargo xtask study ambiguity from sources 1 -->\n").len(), 1);
    }

    #[test]
    fn a_study_that_is_not_there_is_told() {
        let text = "`cargo xtask study ambiguity`, `cargo xtask study nothing`, `cargo xtask study NAME`\n";
        assert_eq!(found(text), [format!("{PAGE}: names the study `nothing`, which is not there")]);
    }
}
