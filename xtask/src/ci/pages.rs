//! Check that pages refer to existing things: source files and tests, libraries that the manifests list and
//! the code uses; and that prose fits the line width.

mod libraries; // listed, described and used
pub(super) mod navigation; // pages of the site

use crate::ci::findings::{self, COLUMNS, fail_on, pages, read};
use crate::project::project_root;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use wayside::host::failure::Failure;

/// Pages written by programs, whose line width is not checked.
const MADE: [&str; 2] = ["docs/atlas.md", "docs/pictures"];

pub(super) fn check() -> Result<(), Failure> {
    let root = project_root();
    let sources = sources(&root);
    let mut broken = Vec::new();
    for page in &pages(&root) {
        let text = read(page)?;
        let name = page.strip_prefix(&root).unwrap_or(page).display().to_string();
        let gone = gone_files(&text, &sources).into_iter().chain(gone_tests(&text, &sources));
        broken.extend(gone.map(|what| format!("{name}: names {what}, which is not there")));
        if !MADE.iter().any(|made| name.starts_with(made)) {
            broken.extend(
                long_lines(&text)
                    .into_iter()
                    .map(|line| format!("{name}:{line}: more than {COLUMNS} columns")),
            );
        }
    }
    broken.extend(libraries::findings(&root)?);
    fail_on(broken)
}

/// Paths of all source files of the workspace, relative to its root.
fn sources(root: &Path) -> BTreeSet<String> {
    let from_root = |file: PathBuf| Some(file.strip_prefix(root).ok()?.display().to_string());
    findings::sources().into_iter().filter_map(from_root).collect()
}

/// Words in backticks that end with `.rs` but match the end of no source file's path.
fn gone_files(text: &str, sources: &BTreeSet<String>) -> Vec<String> {
    let named =
        text.split('`').skip(1).step_by(2).filter(|word| word.ends_with(".rs") && !word.contains([' ', '*']));
    let is_there = |word: &&str| {
        let end = word.trim_start_matches("../");
        sources.iter().any(|file| file == end || file.ends_with(&format!("/{end}")))
    };
    named.filter(|word| !is_there(word)).map(str::to_owned).collect()
}

/// Missing test programs in commands: `-p CRATE --test NAME`.
fn gone_tests(text: &str, sources: &BTreeSet<String>) -> Vec<String> {
    let words: Vec<&str> = text.split(|c: char| c.is_whitespace() || c == '`').collect();
    let mut package = "";
    let mut gone = Vec::new();
    for pair in words.windows(2) {
        match pair {
            ["cargo", _] => package = "",
            ["-p" | "--package", name] => package = name,
            ["--test", name] => {
                let folder =
                    if package == "xtask" { "xtask".to_owned() } else { format!("crates/{package}") };
                let places = [format!("{folder}/tests/{name}.rs"), format!("{folder}/tests/{name}/main.rs")];
                if folder != "crates/" && !places.iter().any(|place| sources.contains(place)) {
                    gone.push(format!("the test `{name}` of `{package}`"));
                }
            }
            _ => {}
        }
    }
    gone
}

/// Numbers of lines of prose that are too long; tables, pictures, links and programs may be wider.
fn long_lines(text: &str) -> Vec<usize> {
    let (mut is_code, mut long) = (false, vec![]);
    for (line, number) in text.lines().zip(1..) {
        let inside = line.trim_start();
        is_code ^= inside.starts_with("```");
        let is_prose = !is_code && !inside.starts_with(['|', '<', '!', '#']) && !line.starts_with("    ");
        if is_prose && line.chars().count() > COLUMNS && line.trim().contains(' ') {
            long.push(number);
        }
    }
    long
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_page_names_has_to_be_there() {
        let sources = BTreeSet::from(
            ["crates/dsp/src/cfar.rs", "crates/dsp/tests/detection/main.rs"].map(str::to_owned),
        );
        let text =
            "`cfar.rs`, `dsp/src/cfar.rs`, `old.rs`; `cargo test -p dsp --test detection -p dsp --test gone`";
        assert_eq!(gone_files(text, &sources), ["old.rs"]);
        assert_eq!(gone_tests(text, &sources), ["the test `gone` of `dsp`"]);
        let other = "`cargo run -p dsp` and `cargo xtask protocols out/own --test out/real`";
        assert!(gone_tests(other, &sources).is_empty(), "the option of another command");
    }

    #[test]
    fn prose_is_measured_and_tables_are_not() {
        let long = "word ".repeat(30);
        let text = format!("{long}\n| {long} |\n```\n{long}\n```\n    {long}\nshort\n{long}\n");
        assert_eq!(long_lines(&text), [1, 8]);
    }
}
