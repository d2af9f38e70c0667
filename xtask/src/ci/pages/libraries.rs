//! Check of libraries: each in the workspace's list has a row with the reason, and each in a crate's list is
//! named in its code.

use crate::ci::findings::read;
use crate::house::folders;
use std::collections::BTreeSet;
use std::path::Path;
use wayside::host::failure::Failure;

/// Remark on a dependency that only sets features of another one.
const FEATURES: &str = "for its features alone";

/// A sentence for each library without a row, and for each unused one.
pub(super) fn findings(root: &Path) -> Result<Vec<String>, Failure> {
    let page = read(&root.join("docs/decisions/dependencies.md"))?;
    let mut all = untold(&read(&root.join("Cargo.toml"))?, &page);
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
fn untold(manifest: &str, page: &str) -> Vec<String> {
    let section = manifest.split("[workspace.dependencies]").nth(1).unwrap_or_default();
    let section = section.split("\n[").next().unwrap_or_default();
    let listed =
        section.lines().filter(|line| !line.contains("path = ")).filter_map(|line| line.split_once(" = "));
    let listed: BTreeSet<String> = listed.map(|(name, _)| name.trim().replace('_', "-")).collect();
    let rows = page.lines().filter_map(|line| line.strip_prefix("| ")?.split(" | ").next());
    let words = rows.flat_map(|row| row.split(|c: char| !(c.is_alphanumeric() || "-_".contains(c))));
    let told: BTreeSet<String> = words.map(|word| word.replace('_', "-")).collect();
    let missing = listed.iter().filter(|name| !told.contains(*name));
    missing.map(|name| format!("docs/decisions/dependencies.md: no row tells of `{name}`")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_library_has_its_reason() {
        let manifest = "[workspace.dependencies]\nown = { path = \"x\" }\nserde = \"1\"\nnum_traits = \"1\"\n\
                        clap = \"4\"\n[profile]\n";
        let page = "| library | for |\n|---|---|\n| serde, num-traits | records |\n";
        assert_eq!(untold(manifest, page), ["docs/decisions/dependencies.md: no row tells of `clap`"]);
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
