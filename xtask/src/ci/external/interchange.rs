//! Check of messages of OSI and ROS 2 with the official packages, and of traffic from SUMO, OpenDRIVE and
//! OpenStreetMap through the program. It tests the crate `interchange`, builds the program with the feature
//! of that name, which nothing else builds, and otherwise needs a Python with `venv` and PyPI; without them
//! it is skipped with a message.

use crate::ci::commands::{Tally, run_checked, run_tests};
use crate::ci::external::interpreter::{Interpreter, PythonRequirements};
use crate::project::{project_root, this_program};
use std::path::Path;
use std::process::Command;
use wayside::host::failure::Failure;

/// Scripts of the check, relative to the project's root.
const SCRIPTS: &str = "docs/interchange";
/// The program with the feature.
const PROGRAM: [&str; 5] = ["--release", "--package", "wayside", "--features", "interchange"];

pub(crate) fn check(tally: &mut Tally) -> Result<(), Failure> {
    let lints = ["clippy", "--release", "--all-targets", "--package", "interchange"];
    let above = ["--package", "formats", "--package", "wayside", "--features", "wayside/interchange"];
    let lints = [&lints[..], &above, &["--", "-D", "warnings"]].concat();
    run_checked(Command::new("cargo").args(lints))?;
    let tests = ["test", "--release", "--package", "interchange"];
    run_tests(Command::new("cargo").args(tests), tally)?;
    run_scripts(SCRIPTS, tally)
}

/// Runs `check.py` of a folder of scripts, in a separate environment, on the program with the feature.
pub(super) fn run_scripts(scripts: &str, tally: &mut Tally) -> Result<(), Failure> {
    let folder = project_root().join("target").join(Path::new(scripts).file_name().unwrap_or_default());
    let requirements = format!("{scripts}/requirements.txt");
    let needs = PythonRequirements::for_scripts(&requirements);
    let Some(python) = Interpreter::prepare(&needs, &folder, tally)? else { return Ok(()) };
    run_checked(Command::new("cargo").arg("build").args(PROGRAM))?;
    let this = this_program()?;
    let work = folder.join("work");
    let _ = std::fs::remove_dir_all(&work);
    let mut command = Command::new(python.program());
    let program = this.with_file_name(format!("wayside{}", std::env::consts::EXE_SUFFIX));
    run_tests(command.arg(format!("{scripts}/check.py")).arg(program).arg(&work), tally)
}
