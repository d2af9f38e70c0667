//! Check of the site: renders its pages, follows every link, and runs every command on them, comparing the
//! output with the page. It needs a Python with `venv` and PyPI; without them it is skipped with a message.

use crate::ci::commands::{Tally, run_tests};
use crate::ci::external::interpreter::{Interpreter, PYTHON, PythonRequirements};
use crate::project::{project_root, this_program};
use std::process::Command;
use wayside::host::failure::Failure;

/// Scripts of the check, relative to the project's root.
const SCRIPTS: &str = "docs/site";
/// Python that the scripts require, for `tomllib`.
const NEEDED: &str = "import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))";

pub(crate) fn check(tally: &mut Tally) -> Result<(), Failure> {
    let requirements = format!("{SCRIPTS}/requirements.txt");
    let needs = PythonRequirements {
        interpreter: PYTHON,
        expression: NEEDED,
        in_words: "no Python of version 3.11 with venv (PYTHON names it)",
        requirements: &requirements,
    };
    let folder = project_root().join("target/site");
    let Some(python) = Interpreter::prepare(&needs, &folder, tally)? else { return Ok(()) };
    let script = |name: &str| {
        let mut command = Command::new(python.program());
        command.arg(format!("{SCRIPTS}/{name}"));
        command
    };
    run_tests(script("build.py").arg(folder.join("site")), tally)?;
    // This program carries out the commands of `wayside`.
    let program = this_program()?;
    run_tests(script("check.py").arg(program), tally)
}
