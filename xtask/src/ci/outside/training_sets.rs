//! Training sets in the layouts of others beside what the program's artifacts hold, by NumPy, SciPy and
//! pandas, and sets of others read (docs/training-sets.md). It builds the program with the feature
//! `interchange`; where a Python with `venv` or PyPI is not there it says so and is skipped.

use crate::ci::commands::{Tally, counted, finished};
use crate::ci::outside::interchange::PROGRAM;
use crate::ci::outside::interpreter::{Interpreter, Needs};
use crate::project::project_root;
use std::process::Command;
use wayside::host::failure::Failure;

/// Scripts of the check, from the project's root on.
const SCRIPTS: &str = "docs/training-sets";

pub(crate) fn check(tally: &mut Tally) -> Result<(), Failure> {
    let folder = project_root().join("target/training-sets");
    let requirements = format!("{SCRIPTS}/requirements.txt");
    let needs = Needs::of_scripts(&requirements);
    let Some(python) = Interpreter::of(&needs, &folder, tally)? else { return Ok(()) };
    finished(Command::new("cargo").arg("build").args(PROGRAM))?;
    let this = std::env::current_exe().map_err(|e| Failure::System(format!("this program: {e}")))?;
    let work = folder.join("work");
    let _ = std::fs::remove_dir_all(&work);
    let mut command = Command::new(python.program());
    let program = this.with_file_name(format!("wayside{}", std::env::consts::EXE_SUFFIX));
    counted(command.arg(format!("{SCRIPTS}/check.py")).arg(program).arg(&work), tally)
}
