//! Check of libraries: each in the workspace's list has a row with the reason, each row is about libraries in
//! the list, and each in a crate's list is named in its code.

use crate::ci::findings::read;
use crate::house::folders;
use std::collections::BTreeSet;
use std::path::Path;
use wayside::host::failure::Failure;

/// Remark on a dependency that only sets features of another one.
const FEATURES: &str = "for its features alone";

/// Page with the table of the libraries.
const PAGE: &str = "docs/decisions/dependencies.md";

/// A sentence for each library without a row, for each row without a library, and for each unused library.
pub(super) fn findings(root: &Path) -> Result<Vec<String>, Failure> {
    let (page, workspace) = (read(&root.join(PAGE))?, read(&root.join("Cargo.toml"))?);
    let mut all = [unexplained(&workspace, &page), unlisted(&workspace, &page)].concat();
    let crates = std::fs::read_dir(root.join("crates")).into_iter().flatten().flatten();
    for folder in crates.map(|entry| entry.path()).chain([root.join("xtask")]) {
        let manifest = folder.join("Cargo.toml");
        let mut code = String::new();
        for file in folders::sources(&folder) {
            code.push_str(&read(&file)?);
        }
        let name = manifest.strip_prefix(root).unwrap_or(&manifest).display().to_string();
        let unused = unused(&read(&manifest)?, &code);
        all.extend(unused.into_iter().map(|library| format!("{name}: `{library}` is used nowhere")));
    }
    all.sort();
    Ok(all)
}

/// Dependencies of a manifest that are not named in the crate's code.
fn unused(manifest: &str, code: &str) -> Vec<String> {
    let words: BTreeSet<&str> = code.split(|c: char| !(c.is_alphanumeric() || c == '_')).collect();
    let mut is_listed = false;
    let mut unused = Vec::new();
    for line in manifest.lines() {
        if line.starts_with('[') {
            is_listed = line.trim_end_matches(']').ends_with("dependencies");
        }
        let name: String = line.chars().take_while(|c| c.is_alphanumeric() || "-_".contains(*c)).collect();
        let is_told = line.contains(FEATURES);
        if is_listed && !name.is_empty() && !is_told && !words.contains(name.replace('-', "_").as_str()) {
            unused.push(name);
        }
    }
    unused
}

/// A sentence for each library of the workspace without a row.
fn unexplained(manifest: &str, page: &str) -> Vec<String> {
    let told = named(page);
    let missing = listed(manifest).into_iter().filter(|name| !told.contains(name));
    missing.map(|name| format!("{PAGE}: no row tells of `{name}`")).collect()
}

/// A sentence for each library with a row that the workspace does not list.
fn unlisted(manifest: &str, page: &str) -> Vec<String> {
    let listed = listed(manifest);
    let gone = named(page).into_iter().filter(|name| !listed.contains(name));
    gone.map(|name| format!("{PAGE}: `{name}` has a row and is in no manifest")).collect()
}

/// Libraries of the workspace's list, without its own crates.
fn listed(manifest: &str) -> BTreeSet<String> {
    let section = manifest.split("[workspace.dependencies]").nth(1).unwrap_or_default();
    let section = section.split("\n[").next().unwrap_or_default();
    let lines =
        section.lines().filter(|line| !line.contains("path = ")).filter_map(|line| line.split_once(" = "));
    lines.map(|(name, _)| name.trim().replace('_', "-")).collect()
}

/// Libraries in the first column of the page's first table, the one before any heading of a section.
fn named(page: &str) -> BTreeSet<String> {
    let table = page.split("\n## ").next().unwrap_or_default();
    let rows = table.lines().filter_map(|line| line.strip_prefix("| ")?.split(" | ").next());
    rows.filter(|row| *row != "library").flat_map(names).collect()
}

/// Libraries of a row, without the remarks in brackets and the versions.
fn names(row: &str) -> Vec<String> {
    let parts = row.split('(').map(|part| part.split_once(')').map_or(part, |(_, behind)| behind));
    let plain: String = parts.collect();
    let first = |words: &str| words.split_whitespace().next().map(|name| name.replace('_', "-"));
    plain.split(',').filter_map(first).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_library_has_its_reason() {
        let manifest = "[workspace.dependencies]\nown = { path = \"x\" }\nserde = \"1\"\nnum_traits = \"1\"\n\
                        clap = \"4\"\n[profile]\n";
        let page = "| library | for |\n|---|---|\n| serde, num-traits | records |\n";
        assert_eq!(unexplained(manifest, page), ["docs/decisions/dependencies.md: no row tells of `clap`"]);
    }

    #[test]
    fn a_row_about_a_library_that_is_gone_is_found() {
        let manifest = "[workspace.dependencies]\nown = { path = \"x\" }\nserde = \"1\"\nmcap = \"0\"\n";
        let page = "| library | for |\n|---|---|\n| serde (`std`, derive), num_traits 0.2 | records |\n\
                    | mcap (no C; one crate only) | files |\n\n\
                    ## Builds\n\n| crates | time |\n|---|---|\n| 160 | 5 min |\n";
        let told = "docs/decisions/dependencies.md: `num-traits` has a row and is in no manifest";
        assert_eq!(unlisted(manifest, page), [told]);
        assert_eq!(names("a_b (`c`, d), e 1.2.3"), ["a-b", "e"]);
    }

    #[test]
    fn a_library_that_no_code_names_is_found() {
        let manifest = "[package]\nname = \"x\"\n[dependencies]\nnum-complex.workspace = true\n\
                        once_cell = \"1\" # for its features alone\nrobust = \"1\"\n\
                        [dev-dependencies]\nobvhs = \"0.3\"\n\
                        [lints]\nworkspace = true\n";
        assert_eq!(unused(manifest, "use num_complex::Complex64; // robustly"), ["robust", "obvhs"]);
    }
}
