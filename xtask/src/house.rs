//! `house`: statistics of the source by crate: files, code with and without tests, dependencies between
//! files, cycles, and files per folder. `ci` refuses cycles and crowded folders by the same counts.

pub(crate) mod source;
pub(crate) mod names;
pub(crate) mod arrows;
pub(crate) mod circles;
pub(crate) mod folders;

use crate::project::project_root;
use arrows::Arrows;
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
    let (mut files, mut code, mut product, mut count, mut circles) = (0, 0, 0, 0, 0);
    for folder in crates(&project_root())? {
        let (arrows, found) = look(&folder)?;
        let lengths: Vec<usize> = arrows.files.iter().map(|file| file.code_lines()).collect();
        let largest = lengths.iter().max().unwrap_or(&0);
        let (lines, own, name) =
            (lengths.iter().sum::<usize>(), product_lines(&arrows.files), name_of(&folder));
        terminal::line(format!(
            "{name:<22}{:>6}{lines:>8}{own:>9}{:>8}{:>9}{:>16}{largest:>14}",
            arrows.files.len(),
            arrows.count(),
            found.len(),
            folders::side_by_side(&folder).into_values().max().unwrap_or(0),
        ));
        files += arrows.files.len();
        (code, product) = (code + lines, product + own);
        (count, circles) = (count + arrows.count(), circles + found.len());
    }
    terminal::line(format!("{:<22}{files:>6}{code:>8}{product:>9}{count:>8}{circles:>9}", "all"));
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
pub(crate) fn look(folder: &Path) -> Result<(Arrows, Vec<Vec<usize>>), Failure> {
    let arrows = Arrows::of(&folder.join("src"))?;
    let circles = circles::of(&arrows.to);
    Ok((arrows, circles))
}

/// Name of a crate, which is that of its folder.
pub(crate) fn name_of(folder: &Path) -> String {
    folder.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
