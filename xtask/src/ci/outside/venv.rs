//! A Python environment with pinned packages, for checks that ask programs of others. Where there is no
//! Python with `venv` or no PyPI it says so, and the check counts as skipped.

use crate::ci::commands::{Tally, finished};
use crate::project::project_root;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use wayside::host::failure::Failure;
use wayside::program::terminal;

/// A package of some kilobytes: whether PyPI is there.
const SMALL_PACKAGE: &str = "zipp==4.1.2";
/// Needs that the scripts of checks have of a Python, and that processes are listed in /proc.
const NEEDED: &str =
    "import ensurepip, os, sys, venv; sys.exit(sys.version_info < (3, 10) or not os.path.isdir('/proc/1'))";

/// The interpreter of an environment in a folder, with the packages of a list; `None` where it cannot be had.
pub(super) fn interpreter(
    folder: &Path,
    requirements: &str,
    tally: &mut Tally,
) -> Result<Option<PathBuf>, Failure> {
    let python = std::env::var_os("PYTHON").unwrap_or("python3".into());
    if !is_good(Command::new(&python).args(["-c", NEEDED])) {
        skipped(tally, "no Python of version 3.10 with venv on a system with /proc (PYTHON names it)");
        return Ok(None);
    }
    let venv = folder.join("venv");
    let interpreter = venv.join("bin/python");
    if !interpreter.exists() {
        finished(Command::new(&python).args(["-m", "venv"]).arg(&venv))?;
    }
    let pins = pins(requirements)?;
    let installed = venv.join("installed.txt");
    if !std::fs::read_to_string(&installed).is_ok_and(|there| there == pins) {
        if !is_good(pip(&venv, "download").args(["--no-deps", SMALL_PACKAGE, "--dest"]).arg(folder)) {
            skipped(tally, "PyPI is not there for pip");
            return Ok(None);
        }
        finished(pip(&venv, "install").args(["--requirement", requirements]))?;
        std::fs::write(&installed, pins).map_err(|e| Failure::system(&venv, "write", e))?;
    }
    Ok(Some(interpreter))
}

fn skipped(tally: &mut Tally, why: &str) {
    terminal::line(format!("skipped: {why}"));
    tally.skipped += 1;
}

fn is_good(command: &mut Command) -> bool {
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

fn pip(venv: &Path, word: &str) -> Command {
    let mut command = Command::new(venv.join("bin/python"));
    command.args(["-m", "pip", word, "--quiet", "--disable-pip-version-check", "--timeout", "20"]);
    command.args(["--retries", "1"]);
    command
}

/// The text of a list of packages.
fn pins(requirements: &str) -> Result<String, Failure> {
    let file = project_root().join(requirements);
    std::fs::read_to_string(&file).map_err(|e| Failure::system(&file, "read", e))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_package_of_a_check_has_its_version() {
        for (list, needed) in [
            ("docs/engines/requirements.txt", &["hyperqueue", "distributed", SMALL_PACKAGE][..]),
            ("docs/interchange/requirements.txt", &["osi-python", "mcap-ros2-support", "eclipse-sumo"]),
        ] {
            let pins = pins(list).unwrap();
            let packages: Vec<&str> = pins.lines().filter(|line| !line.starts_with('#')).collect();
            assert!(packages.iter().all(|line| line.contains("==")), "{pins}");
            for name in needed {
                assert!(packages.iter().any(|line| line.starts_with(name)), "{name}");
            }
        }
    }
}
