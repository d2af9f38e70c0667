//! Stand-in for tables of Parquet in a program built without them.

use artifact::Reader;
use artifact::points::Points;
use pipeline::host::failure::Failure;
use std::path::Path;

/// Refuses to write points as a table.
pub fn points(_reader: Reader<Points>, _out: &Path) -> Result<(), Failure> {
    Err(without())
}

/// Refuses to write samples as a table.
pub fn samples(_asked: &Path, _out: &Path) -> Result<(), Failure> {
    Err(without())
}

fn without() -> Failure {
    let how =
        "`cargo install --path crates/wayside --features interchange` in the project's folder builds one";
    Failure::System(format!(
        "--to parquet: this program was built without tables of Parquet; {how} with them"
    ))
}
