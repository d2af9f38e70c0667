//! Tables of Parquet, in a program that was built without them.

use crate::host::failure::Failure;
use artifact::Reader;
use artifact::points::Points;
use std::path::Path;

pub(crate) fn points(_reader: Reader<Points>, _out: &Path) -> Result<(), Failure> {
    Err(without())
}

pub(crate) fn samples(_asked: &Path, _out: &Path) -> Result<(), Failure> {
    Err(without())
}

fn without() -> Failure {
    let how =
        "`cargo install --path crates/wayside --features interchange` in the project's folder builds one";
    Failure::System(format!(
        "--to parquet: this program was built without tables of Parquet; {how} with them"
    ))
}
