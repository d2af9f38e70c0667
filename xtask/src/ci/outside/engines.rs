//! Datasets and sweeps on existing engines whose workers are killed half-way: the bytes of one machine. It
//! stands on a Python with `venv` and on PyPI; where one of them is not there it says so and is skipped.

use crate::ci::commands::{Tally, counted};
use crate::ci::outside::interpreter::{Interpreter, Needs};
use crate::project::{project_root, this_program};
use std::process::Command;
use wayside::host::failure::Failure;
use wayside::program::terminal;

/// Scripts of the check, from the project's root on.
const SCRIPTS: &str = "docs/engines";

pub(crate) fn check(tally: &mut Tally) -> Result<(), Failure> {
    let folder = project_root().join("target/engines");
    let requirements = script("requirements.txt");
    let needs = Needs::of_scripts(&requirements);
    let Some(python) = Interpreter::of(&needs, &folder, tally)? else { return Ok(()) };
    let work = folder.join("work");
    let program = this_program()?;
    let mut check = || {
        let _ = std::fs::remove_dir_all(&work);
        let mut command = Command::new(python.program());
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

fn script(name: &str) -> String {
    format!("{SCRIPTS}/{name}")
}
