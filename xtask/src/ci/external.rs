//! A crate outside the workspace that depends on `wayside` by its path, with the Rust example of the page on
//! installing: the public interface must compile for users of the library too.

mod interpreter; // a Python with its own packages
pub(super) mod installed; // the program by `cargo install`, in an empty folder
pub(super) mod engines; // datasets and sweeps on existing engines
pub(super) mod interchange; // messages with the official packages, traffic from SUMO
pub(super) mod training_sets; // frames in the layouts of public datasets
pub(super) mod python; // the Python package
pub(super) mod report_view; // a report in a browser
pub(super) mod site; // pages rendered, and their commands run

use crate::ci::commands::run_checked;
use crate::ci::findings::read;
use crate::project::project_root;
use std::path::Path;
use std::process::Command;
use wayside::host::failure::Failure;

/// Page with the example.
const PAGE: &str = "docs/install.md";
/// Mark of the example.
const MARK: &str = "```rust,no_run\n";

pub(super) fn check() -> Result<(), Failure> {
    let (root, folder) = (project_root(), project_root().join("target/outside"));
    write(&folder.join("src/main.rs"), &program(&block(PAGE, MARK)?))?;
    let workspace = read(&root.join("Cargo.toml"))?;
    write(&folder.join("Cargo.toml"), &manifest(&root, profiles(&workspace)))?;
    // The same versions as here; the workspace's downloads suffice.
    write(&folder.join("Cargo.lock"), &read(&root.join("Cargo.lock"))?)?;
    // By its manifest: commands of a check run in the project's root, which is another package. Profiles and
    // folder are the workspace's, so that libraries are not linted again.
    let mut check = Command::new("cargo");
    check.args(["check", "--release", "--offline", "--manifest-path"]).arg(folder.join("Cargo.toml"));
    run_checked(check.arg("--target-dir").arg(root.join("target")))
}

/// Profiles in the workspace's manifest, which precede its lints.
fn profiles(workspace: &str) -> &str {
    let from = workspace.find("[profile").unwrap_or(workspace.len());
    let to = workspace[from..].find("[workspace").map_or(workspace.len(), |length| from + length);
    &workspace[from..to]
}

/// Lines of the first block of a page that begins with a mark.
fn block(page: &str, mark: &str) -> Result<String, Failure> {
    let text = read(&project_root().join(page))?;
    let promised = || Failure::Refused(format!("{page}: a block that begins with {mark:?} is promised"));
    lines_of(&text, mark).map(str::to_owned).ok_or_else(promised)
}

fn lines_of<'a>(text: &'a str, mark: &str) -> Option<&'a str> {
    let (_, rest) = text.split_once(mark)?;
    rest.split_once("```").map(|(lines, _)| lines)
}

fn program(lines: &str) -> String {
    format!("fn main() -> Result<(), wayside::Failure> {{\n{lines}    Ok(())\n}}\n")
}

/// A separate package, outside any workspace, without the classifier, which also checks the build without it.
fn manifest(root: &Path, profiles: &str) -> String {
    let place = root.join("crates/wayside");
    format!(
        "[package]\nname = \"outside\"\nedition = \"2024\"\n\n[dependencies]\nwayside = {{ path = {place:?}, default-features = false }}\n\n\
         [workspace]\n\n{profiles}"
    )
}

fn write(file: &Path, text: &str) -> Result<(), Failure> {
    let folder = file.parent().unwrap_or(file);
    std::fs::create_dir_all(folder).map_err(|e| Failure::system(folder, "create", e))?;
    std::fs::write(file, text).map_err(|e| Failure::system(file, "write", e))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_example_of_the_page_is_the_body_of_a_program() {
        let page = format!("text\n{MARK}let a = 1;\n```\n```rust\nother\n```\n");
        let program = program(lines_of(&page, MARK).unwrap());
        assert_eq!(program, "fn main() -> Result<(), wayside::Failure> {\nlet a = 1;\n    Ok(())\n}\n");
        assert_eq!(lines_of("no block", MARK), None);
    }

    #[test]
    fn the_page_on_installing_has_the_example() {
        assert!(block(PAGE, MARK).unwrap().contains("wayside::run("));
        let missing = block(PAGE, "```no such block\n").unwrap_err().to_string();
        assert!(missing.starts_with(PAGE), "{missing}");
    }

    #[test]
    fn the_profiles_are_those_of_the_workspace_and_nothing_else() {
        let text = "[workspace]\n[profile.release]\na = 1\n[profile.release.package.b]\nc = 2\n[workspace.lints.d]\n";
        assert_eq!(profiles(text), "[profile.release]\na = 1\n[profile.release.package.b]\nc = 2\n");
        assert_eq!(profiles("[workspace]\n"), "");
    }
}
