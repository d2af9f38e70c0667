//! Datasets and sweeps on existing engines whose workers are killed half-way: the bytes of one machine. It
//! stands on a Python with `venv` and on PyPI; where one of them is not there it says so and is skipped.

use crate::ci::commands::{Tally, counted, finished, skipped};
use crate::project::project_root;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use wayside::host::failure::Failure;
use wayside::program::terminal;

/// Scripts of the check, from the project's root on.
const SCRIPTS: &str = "docs/engines";
/// A package of some kilobytes: whether PyPI is there.
const SMALL_PACKAGE: &str = "zipp==4.1.2";
/// Needs that the scripts of this check have of a Python, and that processes are listed in /proc.
const NEEDED: &str =
    "import ensurepip, os, sys, venv; sys.exit(sys.version_info < (3, 10) or not os.path.isdir('/proc/1'))";

pub(crate) fn check(tally: &mut Tally) -> Result<(), Failure> {
    let python = std::env::var_os("PYTHON").unwrap_or("python3".into());
    if !is_good(Command::new(&python).args(["-c", NEEDED])) {
        return skipped(
            tally,
            "no Python of version 3.10 with venv on a system with /proc (PYTHON names it)",
        );
    }
    let folder = project_root().join("target/engines");
    let venv = folder.join("venv");
    if !venv.join("bin/python").exists() {
        finished(Command::new(&python).args(["-m", "venv"]).arg(&venv))?;
    }
    if !has_engines(&venv) {
        if !is_good(pip(&venv, "download").args(["--no-deps", SMALL_PACKAGE, "--dest"]).arg(&folder)) {
            return skipped(tally, "PyPI is not there for pip");
        }
        finished(pip(&venv, "install").args(["--requirement", &script("requirements.txt")]))?;
        std::fs::write(installed(&venv), pins()?).map_err(|e| Failure::system(&venv, "write", e))?;
    }
    let work = folder.join("work");
    let program = std::env::current_exe().map_err(|e| Failure::System(format!("this program: {e}")))?;
    let mut check = || {
        let _ = std::fs::remove_dir_all(&work);
        let mut command = Command::new(venv.join("bin/python"));
        // It carries out the commands of `wayside`.
        counted(command.arg(script("check.py")).arg(&program).arg(&work), tally)
    };
    for _ in 0..TRIED_AGAIN {
        match check() {
            Ok(()) => return Ok(()),
            Err(failure) => terminal::line(format!("tried again: {failure}")),
        }
    }
    check()
}

/// Times that a check which failed is tried again: a worker that has made all before it is killed shows
/// nothing, and that is chance.
const TRIED_AGAIN: u32 = 2;

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

/// Whether the pinned versions were installed there before.
fn has_engines(venv: &Path) -> bool {
    std::fs::read_to_string(installed(venv)).is_ok_and(|there| pins().is_ok_and(|pins| pins == there))
}

fn installed(venv: &Path) -> PathBuf {
    venv.join("installed.txt")
}

fn pins() -> Result<String, Failure> {
    let file = project_root().join(script("requirements.txt"));
    std::fs::read_to_string(&file).map_err(|e| Failure::system(&file, "read", e))
}

fn script(name: &str) -> String {
    format!("{SCRIPTS}/{name}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_package_of_the_engines_has_its_version() {
        let pins = pins().unwrap();
        let packages: Vec<&str> = pins.lines().filter(|line| !line.starts_with('#')).collect();
        assert!(packages.iter().all(|line| line.contains("==")), "{pins}");
        for engine in ["hyperqueue", "distributed"] {
            assert!(packages.iter().any(|line| line.starts_with(engine)), "{engine}");
        }
        assert!(packages.contains(&SMALL_PACKAGE));
    }
}
