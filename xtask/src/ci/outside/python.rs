//! Check of the Python package as installed by users: `pip install ./crates/wayside-python`, its tests, its
//! stubs against its content, and its notebooks from the first cell to the last. Skipped without a Python or
//! PyPI.

use crate::ci::commands::{Tally, counted, finished};
use crate::ci::outside::interpreter::{Interpreter, Needs};
use crate::project::{project_root, this_program};
use std::process::Command;
use wayside::host::failure::Failure;

/// The package, relative to the project's root.
const PACKAGE: &str = "crates/wayside-python";
/// Python that pip requires.
const NEEDED: &str = "import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))";

pub(crate) fn check(tally: &mut Tally) -> Result<(), Failure> {
    let needs = Needs {
        expression: NEEDED,
        in_words: "no Python of version 3.11 with venv (PYTHON names it)",
        requirements: &format!("{PACKAGE}/tests/requirements.txt"),
    };
    let folder = project_root().join("target/python");
    let Some(python) = Interpreter::of(&needs, &folder, tally)? else { return Ok(()) };
    // Reinstalled whatever its version; its dependencies are present.
    let install = ["--force-reinstall", "--no-deps"];
    finished(python.pip("install").args(install).arg(format!("./{PACKAGE}")))?;
    let lints = ["clippy", "--release", "--package", "wayside-python", "--", "-D", "warnings"];
    finished(Command::new("cargo").args(lints).env("PYO3_PYTHON", python.program()))?;
    let program = this_program()?;
    let run = |words: &[&str]| {
        let mut command = Command::new(python.program());
        // This program carries out the commands of `wayside`.
        command.args(words).env("WAYSIDE_PROGRAM", &program);
        command
    };
    counted(&mut run(&["-m", "pytest", "--quiet", PACKAGE]), tally)?;
    let settings = format!("{PACKAGE}/pyproject.toml");
    finished(&mut run(&["-m", "mypy", "--config-file", &settings, "--package", "wayside"]))?;
    finished(&mut run(&["-m", "mypy.stubtest", "wayside", "--mypy-config-file", &settings]))?;
    finished(&mut run(&[&format!("{PACKAGE}/notebooks/run.py")]))
}
