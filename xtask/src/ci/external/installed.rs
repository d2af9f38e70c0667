//! Check of the program as users install it: `cargo install --path crates/wayside`, then the scene of a page
//! in an empty folder outside the project.

use crate::ci::commands::{run_checked, run_checked_in};
use crate::ci::external::{block, write};
use crate::project::project_root;
use std::path::{Path, PathBuf};
use std::process::Command;
use wayside::host::failure::Failure;
use wayside::outcome::summary::{FrameSummary, Summary, TargetSummary};

/// Page with the scene of one vehicle, which needs no other file.
const PAGE: &str = "docs/own-scene.md";
/// Name of the scene, and of its file.
const NAME: &str = "crossing";

pub(crate) fn check() -> Result<(), Failure> {
    let program = installed(&project_root())?;
    let here = std::env::temp_dir();
    let empty = tempfile::tempdir().map_err(|e| Failure::system(&here, "create a folder in", e))?;
    let file = format!("{NAME}.toml");
    write(&empty.path().join(&file), &scene()?)?;
    let mut run = Command::new(program);
    run.args(["run", &file, "--no-cache", "--quiet"]);
    run_checked_in(empty.path(), &mut run)?;
    let summary = empty.path().join("out").join(NAME).join("summary.json");
    all_found(&summary, &Summary::read(&summary)?.frames)
}

/// Installs the program below `target`, from the workspace's build, libraries and downloads.
fn installed(root: &Path) -> Result<PathBuf, Failure> {
    let (target, place) = (root.join("target"), root.join("target/installed"));
    let mut install = Command::new("cargo");
    install.args(["install", "--path", "crates/wayside", "--locked", "--offline", "--force", "--root"]);
    run_checked(install.arg(&place).arg("--target-dir").arg(target))?;
    Ok(place.join("bin").join(format!("wayside{}", std::env::consts::EXE_SUFFIX)))
}

fn scene() -> Result<String, Failure> {
    block(PAGE, &format!("```toml title=\"{NAME}.toml\"\n"))
}

/// Refuses a run that has not one frame in which every target is found.
fn all_found(file: &Path, frames: &[FrameSummary]) -> Result<(), Failure> {
    let is_found = |target: &TargetSummary| target.found == Some(true);
    match frames {
        [frame] if !frame.targets.is_empty() && frame.targets.iter().all(is_found) => Ok(()),
        _ => Err(Failure::Refused(format!("{}: the installed program misses its vehicle", file.display()))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scene_of_the_page_is_a_file_of_its_own() {
        let scene = scene().unwrap();
        assert!(scene.starts_with(&format!("name = \"{NAME}\"\n")), "{scene}");
        assert!(!scene.contains("```"), "{scene}");
    }

    #[test]
    fn a_run_that_misses_its_vehicle_is_refused() {
        let frame = |found| {
            let target = TargetSummary { found, ..TargetSummary::default() };
            FrameSummary { targets: vec![target], ..FrameSummary::default() }
        };
        let file = Path::new("summary.json");
        assert!(all_found(file, &[frame(Some(true))]).is_ok());
        for frames in [vec![], vec![FrameSummary::default()], vec![frame(Some(false))], vec![frame(None)]] {
            let told = all_found(file, &frames).unwrap_err().to_string();
            assert!(told.starts_with("summary.json: "), "{told}");
        }
    }
}
