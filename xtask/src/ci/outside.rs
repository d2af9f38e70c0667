//! A crate outside the workspace that depends on `wayside` by its path, with the lines of Rust of the README:
//! what is promised to users of the library compiles for them too.

mod interpreter; // a Python with packages of its own
pub(super) mod engines; // datasets and sweeps on engines that others make
pub(super) mod interchange; // messages beside the official packages, traffic from SUMO
pub(super) mod training_sets; // frames in the layouts of others
pub(super) mod python; // the Python package
pub(super) mod report_view; // a report in a browser
pub(super) mod site; // pages rendered, and their commands run

use crate::ci::commands::finished;
use crate::ci::findings::read;
use crate::project::project_root;
use std::path::Path;
use std::process::Command;
use wayside::host::failure::Failure;

/// Mark of the README's example.
const MARK: &str = "```rust,no_run\n";

pub(super) fn check() -> Result<(), Failure> {
    let (root, folder) = (project_root(), project_root().join("target/outside"));
    let lines = example(&read(&root.join("README.md"))?)?;
    write(&folder.join("src/main.rs"), &program(&lines))?;
    write(&folder.join("Cargo.toml"), &manifest(&root))?;
    // The same versions as here; what has been downloaded for the workspace is enough.
    write(&folder.join("Cargo.lock"), &read(&root.join("Cargo.lock"))?)?;
    // By its manifest: commands of a check run in the project's root, which is another package.
    let manifest = folder.join("Cargo.toml");
    finished(Command::new("cargo").args(["check", "--offline", "--manifest-path"]).arg(manifest))
}

/// Lines of the first block of Rust.
fn example(readme: &str) -> Result<String, Failure> {
    let block = readme.split_once(MARK).and_then(|(_, rest)| rest.split_once("```"));
    let block = block.ok_or_else(|| Failure::refused("README.md: a block of Rust is promised"))?;
    Ok(block.0.to_owned())
}

fn program(lines: &str) -> String {
    format!("fn main() -> Result<(), wayside::Failure> {{\n{lines}    Ok(())\n}}\n")
}

/// A package of its own, in no workspace, and without the classifier: what asks for none builds without it.
fn manifest(root: &Path) -> String {
    let place = root.join("crates/wayside");
    format!(
        "[package]\nname = \"outside\"\nedition = \"2024\"\n\n[dependencies]\nwayside = {{ path = {place:?}, default-features = false }}\n\n\
         [workspace]\n"
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
    fn the_example_of_the_readme_is_the_body_of_a_program() {
        let readme = format!("text\n{MARK}let a = 1;\n```\n```rust\nother\n```\n");
        let program = program(&example(&readme).unwrap());
        assert_eq!(program, "fn main() -> Result<(), wayside::Failure> {\nlet a = 1;\n    Ok(())\n}\n");
        assert!(example("no block").is_err());
    }
}
