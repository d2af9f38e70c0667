//! Check that datasets and sweeps on existing engines, with workers killed half-way, give the same bytes as
//! one machine. It needs a Python with `venv` and PyPI; without them it is skipped with a message.

use crate::ci::commands::{Tally, run_tests};
use crate::ci::external::interpreter::{Interpreter, PythonRequirements};
use crate::project::{project_root, this_program};
use std::process::Command;
use wayside::host::failure::Failure;
use wayside::program::terminal;

/// Scripts of the check, relative to the project's root.
const SCRIPTS: &str = "docs/engines";

pub(crate) fn check(tally: &mut Tally) -> Result<(), Failure> {
    let folder = project_root().join("target/engines");
    let requirements = script("requirements.txt");
    let needs = PythonRequirements::for_scripts(&requirements);
    let Some(python) = Interpreter::prepare(&needs, &folder, tally)? else { return Ok(()) };
    let work = folder.join("work");
    let program = this_program()?;
    let mut check = || {
        let _ = std::fs::remove_dir_all(&work);
        let mut command = Command::new(python.program());
        // This program carries out the commands of `wayside`.
        run_tests(command.arg(script("check.py")).arg(&program).arg(&work), tally)
    };
    for _ in 0..TRIED_AGAIN {
        match check() {
            Ok(()) => return Ok(()),
            Err(failure) => terminal::line(format!("tried again: {failure}")),
        }
    }
    check()
}

/// Number of retries after a failure: by chance, a worker may finish all of its work before it is killed,
/// which tests nothing.
const TRIED_AGAIN: u32 = 2;

fn script(name: &str) -> String {
    format!("{SCRIPTS}/{name}")
}
