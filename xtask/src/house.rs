//! `house`: statistics of the source by crate: files, code with and without tests, dependencies between
//! files, cycles, and files per folder. `ci` refuses cycles and crowded folders by the same counts.

pub(crate) mod source;
pub(crate) mod names;
pub(crate) mod dependencies;
pub(crate) mod cycles;
pub(crate) mod folders;

use crate::project::project_root;
use dependencies::FileDependencies;
use source::SourceFile;
use std::path::{Path, PathBuf};
use wayside::host::failure::Failure;
use wayside::program::terminal;

/// A row for each crate.
pub(crate) fn run() -> Result<(), Failure> {
    terminal::line(format!(
        "{:<22}{:>6}{:>8}{:>9}{:>8}{:>9}{:>16}{:>14}",
        "crate", "files", "code", "product", "arrows", "circles", "largest folder", "largest file"
    ));
    let (mut files, mut code, mut product, mut count, mut cycles) = (0, 0, 0, 0, 0);
    for folder in crates(&project_root())? {
        let (dependencies, found) = dependencies_and_cycles(&folder)?;
        let lengths: Vec<usize> = dependencies.files.iter().map(|file| file.code_lines()).collect();
        let largest = lengths.iter().max().unwrap_or(&0);
        let (lines, own, name) =
            (lengths.iter().sum::<usize>(), product_lines(&dependencies.files), crate_name(&folder));
        terminal::line(format!(
            "{name:<22}{:>6}{lines:>8}{own:>9}{:>8}{:>9}{:>16}{largest:>14}",
            dependencies.files.len(),
            dependencies.count(),
            found.len(),
            folders::files_per_folder(&folder).into_values().max().unwrap_or(0),
        ));
        files += dependencies.files.len();
        (code, product) = (code + lines, product + own);
        (count, cycles) = (count + dependencies.count(), cycles + found.len());
    }
    terminal::line(format!("{:<22}{files:>6}{code:>8}{product:>9}{count:>8}{cycles:>9}", "all"));
    Ok(())
}

/// Lines of code of a crate's files without tests, neither those in a file nor files of tests.
fn product_lines(files: &[SourceFile]) -> usize {
    let tests: Vec<Vec<String>> = files.iter().flat_map(SourceFile::modules_of_tests).collect();
    let is_test = |file: &SourceFile| tests.iter().any(|module| file.module.starts_with(module));
    files.iter().filter(|file| !is_test(file)).map(SourceFile::product_lines).sum()
}

/// Folders of the workspace's crates, in the order of their names.
pub(crate) fn crates(root: &Path) -> Result<Vec<PathBuf>, Failure> {
    let place = root.join("crates");
    let entries = std::fs::read_dir(&place).map_err(|e| Failure::system(&place, "read", e))?;
    let mut crates: Vec<PathBuf> =
        entries.flatten().map(|e| e.path()).filter(|p| p.join("src").is_dir()).collect();
    crates.push(root.join("xtask"));
    crates.sort();
    Ok(crates)
}

/// Finds the dependencies and cycles of a crate.
pub(crate) fn dependencies_and_cycles(folder: &Path) -> Result<(FileDependencies, Vec<Vec<usize>>), Failure> {
    let dependencies = FileDependencies::of(&folder.join("src"))?;
    let cycles = cycles::find(&dependencies.to);
    Ok((dependencies, cycles))
}

/// Name of a crate, which is that of its folder.
pub(crate) fn crate_name(folder: &Path) -> String {
    folder.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
