//! A Python with its own packages, for checks that need one: without it or PyPI, they are skipped with a
//! message.

use crate::ci::commands::{Tally, run_checked, skip, succeeds};
use crate::project::project_root;
use std::path::{Path, PathBuf};
use std::process::Command;
use wayside::host::failure::Failure;

/// A package of some kilobytes, to test whether PyPI is reachable.
const SMALL_PACKAGE: &str = "zipp==4.1.2";

/// Environment variable that names the interpreter of most checks, and the interpreter where it is not set.
pub(super) const PYTHON: [&str; 2] = ["PYTHON", "python3"];

/// Requirements of a check.
pub(super) struct PythonRequirements<'a> {
    /// Environment variable that names the interpreter, and the interpreter where it is not set.
    pub(super) interpreter: [&'a str; 2],
    /// Python expression that succeeds if the interpreter is suitable.
    pub(super) expression: &'a str,
    /// Description of the requirement for the message.
    pub(super) in_words: &'a str,
    /// File of pinned packages, relative to the project's root.
    pub(super) requirements: &'a str,
}

impl<'a> PythonRequirements<'a> {
    /// Requirements of scripts that start and kill processes.
    pub(super) fn for_scripts(requirements: &'a str) -> Self {
        Self {
            interpreter: PYTHON,
            expression: "import ensurepip, os, sys, venv; \
                         sys.exit(sys.version_info < (3, 10) or not os.path.isdir('/proc/1'))",
            in_words: "no Python of version 3.10 with venv on a system with /proc (PYTHON names it)",
            requirements,
        }
    }
}

/// An environment with the packages of a check.
pub(super) struct Interpreter {
    venv: PathBuf,
}

impl Interpreter {
    /// Makes the environment in a folder, or reuses one with exactly these versions; counts the check as
    /// skipped and returns `None` without a Python or PyPI.
    pub(super) fn prepare(
        needs: &PythonRequirements,
        folder: &Path,
        tally: &mut Tally,
    ) -> Result<Option<Self>, Failure> {
        let [variable, otherwise] = needs.interpreter;
        let python = std::env::var_os(variable).unwrap_or(otherwise.into());
        if !succeeds(Command::new(&python).args(["-c", needs.expression])) {
            return skip(tally, needs.in_words).map(|()| None);
        }
        let made = Self { venv: folder.join("venv") };
        if !made.program().exists() {
            run_checked(Command::new(&python).args(["-m", "venv"]).arg(&made.venv))?;
        }
        if made.has_packages(needs.requirements) {
            return Ok(Some(made));
        }
        if !succeeds(made.pip("download").args(["--no-deps", SMALL_PACKAGE, "--dest"]).arg(folder)) {
            return skip(tally, "PyPI is not there for pip").map(|()| None);
        }
        run_checked(made.pip("install").args(["--requirement", needs.requirements]))?;
        let installed = made.installed();
        std::fs::write(&installed, pins(needs.requirements)?)
            .map_err(|e| Failure::system(&installed, "write", e))?;
        Ok(Some(made))
    }

    /// The interpreter.
    pub(super) fn program(&self) -> PathBuf {
        self.venv.join("bin/python")
    }

    /// A command of pip that gives up quickly without PyPI.
    pub(super) fn pip(&self, word: &str) -> Command {
        let mut command = Command::new(self.program());
        command.args(["-m", "pip", word, "--quiet", "--disable-pip-version-check", "--timeout", "20"]);
        command.args(["--retries", "1"]);
        command
    }

    /// Whether the pinned versions are already installed.
    fn has_packages(&self, requirements: &str) -> bool {
        std::fs::read_to_string(self.installed())
            .is_ok_and(|there| pins(requirements).is_ok_and(|pins| pins == there))
    }

    fn installed(&self) -> PathBuf {
        self.venv.join("installed.txt")
    }
}

/// Text of a file of pinned packages.
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
            ("docs/training-sets/requirements.txt", &["numpy", "pandas", "pyarrow", "scipy"]),
            ("crates/wayside-python/tests/requirements.txt", &["pytest", "mypy"]),
            ("crates/wayside-python/tests/requirements-oldest.txt", &["numpy==1.24", "pytest"]),
            ("docs/site/requirements.txt", &["zensical"]),
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
