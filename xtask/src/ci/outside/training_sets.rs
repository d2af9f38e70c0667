//! Training sets in the layouts of others beside what the program's artifacts hold, by NumPy, SciPy and
//! pandas, and sets of others read (docs/training-sets.md). It builds the program with the feature
//! `interchange`; where a Python with `venv` or PyPI is not there it says so and is skipped.

use crate::ci::commands::Tally;
use crate::ci::outside::interchange::by_scripts;
use wayside::host::failure::Failure;

/// Scripts of the check, from the project's root on.
const SCRIPTS: &str = "docs/training-sets";

pub(crate) fn check(tally: &mut Tally) -> Result<(), Failure> {
    by_scripts(SCRIPTS, tally)
}
