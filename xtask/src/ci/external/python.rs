//! Check of the Python package as installed by users: `pip install ./crates/wayside-python`, its tests, its
//! stubs against its content, and its notebooks from the first cell to the last; its main tests again with
//! the oldest Python and NumPy that it serves. Skipped without a Python or PyPI.

use crate::ci::commands::{Tally, run_checked, run_tests};
use crate::ci::external::interpreter::{Interpreter, PYTHON, PythonRequirements};
use crate::project::{project_root, this_program};
use std::path::Path;
use std::process::Command;
use wayside::host::failure::Failure;

/// The package, relative to the project's root.
const PACKAGE: &str = "crates/wayside-python";
/// Python that pip requires.
const NEEDED: &str = "import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))";
/// The oldest Python that the package serves.
const OLDEST: &str = "import ensurepip, sys, venv; sys.exit(sys.version_info[:2] != (3, 10))";
/// Tests that are repeated with it, which need nothing but NumPy.
const ON_THE_OLDEST: [&str; 4] = ["test_chain.py", "test_files.py", "test_rcs.py", "test_scene.py"];

pub(crate) fn check(tally: &mut Tally) -> Result<(), Failure> {
    let needs = PythonRequirements {
        interpreter: PYTHON,
        expression: NEEDED,
        in_words: "no Python of version 3.11 with venv (PYTHON names it)",
        requirements: &format!("{PACKAGE}/tests/requirements.txt"),
    };
    let folder = project_root().join("target/python");
    let Some(python) = Interpreter::prepare(&needs, &folder, tally)? else { return Ok(()) };
    // Reinstalled whatever its version; its dependencies are present.
    let install = ["--force-reinstall", "--no-deps"];
    run_checked(python.pip("install").args(install).arg(format!("./{PACKAGE}")))?;
    let lints = ["clippy", "--release", "--package", "wayside-python", "--", "-D", "warnings"];
    run_checked(Command::new("cargo").args(lints).env("PYO3_PYTHON", python.program()))?;
    run_tests(running(&python)?.args(["-m", "pytest", "--quiet", PACKAGE]), tally)?;
    let settings = format!("{PACKAGE}/pyproject.toml");
    run_checked(running(&python)?.args(["-m", "mypy", "--config-file", &settings, "--package", "wayside"]))?;
    run_checked(running(&python)?.args(["-m", "mypy.stubtest", "wayside", "--mypy-config-file", &settings]))?;
    run_checked(running(&python)?.arg(format!("{PACKAGE}/notebooks/run.py")))?;
    test_oldest(&python, &folder, tally)
}

/// An interpreter whose tests call this program for the commands of `wayside`.
fn running(python: &Interpreter) -> Result<Command, Failure> {
    let mut command = Command::new(python.program());
    command.env("WAYSIDE_PROGRAM", this_program()?);
    Ok(command)
}

/// Tests the wheel with the oldest Python and NumPy; skipped where there is no such Python.
fn test_oldest(python: &Interpreter, folder: &Path, tally: &mut Tally) -> Result<(), Failure> {
    let needs = PythonRequirements {
        interpreter: ["PYTHON_OLDEST", "python3.10"],
        expression: OLDEST,
        in_words: "the package with CPython 3.10: none with venv is there (PYTHON_OLDEST names it)",
        requirements: &format!("{PACKAGE}/tests/requirements-oldest.txt"),
    };
    let Some(oldest) = Interpreter::prepare(&needs, &folder.join("oldest"), tally)? else { return Ok(()) };
    let wheels = folder.join("wheels");
    let _ = std::fs::remove_dir_all(&wheels);
    run_checked(
        python.pip("wheel").args(["--no-deps", "--wheel-dir"]).arg(&wheels).arg(format!("./{PACKAGE}")),
    )?;
    let install = ["--force-reinstall", "--no-deps", "--no-index", "wayside", "--find-links"];
    run_checked(oldest.pip("install").args(install).arg(&wheels))?;
    let tests = ON_THE_OLDEST.map(|name| format!("{PACKAGE}/tests/{name}"));
    run_tests(running(&oldest)?.args(["-m", "pytest", "--quiet"]).args(tests), tally)
}
