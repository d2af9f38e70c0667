//! Check of exported training datasets against the program's artifacts, by NumPy, SciPy and pandas, and of
//! reading such datasets (docs/training-sets.md). It builds the program with the feature `interchange`;
//! without a Python with `venv` or PyPI it is skipped with a message.

use crate::ci::commands::Tally;
use crate::ci::external::interchange::run_scripts;
use wayside::host::failure::Failure;

/// Scripts of the check, relative to the project's root.
const SCRIPTS: &str = "docs/training-sets";

pub(crate) fn check(tally: &mut Tally) -> Result<(), Failure> {
    run_scripts(SCRIPTS, tally)
}
