//! Stand-in for messages of other programs in a program built without them.

use pipeline::host::failure::Failure;
use std::path::Path;

/// Refuses to write messages of ASAM OSI.
pub fn osi(_file: &Path, _schema: &str, _out: &Path) -> Result<(), Failure> {
    Err(without("osi"))
}

/// Refuses to write messages of ROS 2.
pub fn mcap(_file: &Path, _schema: &str, _out: &Path) -> Result<(), Failure> {
    Err(without("mcap"))
}

/// Refuses to write messages of Foxglove.
pub fn foxglove(_file: &Path, _out: &Path) -> Result<(), Failure> {
    Err(without("foxglove"))
}

fn without(format: &str) -> Failure {
    Failure::System(format!(
        "--to {format}: this program was built without messages of OSI, ROS 2 and Foxglove; `cargo install \
         --path crates/wayside --features interchange` in the project's folder builds one with them"
    ))
}
