//! Results on standard output, and whole files or none.

use crate::failure::Failure;
use crate::progress::beside_the_bar;
use artifact::whole_file::{Durability, WholeFile};
use std::io::Write;
use std::path::Path;

/// A line of results. A reader that has gone away (`| head`) ends the program quietly.
pub(crate) fn line(text: impl std::fmt::Display) {
    if beside_the_bar(|| writeln!(std::io::stdout(), "{text}")).is_err() {
        std::process::exit(0);
    }
}

/// Writes `file` whole or not at all; folders that are missing are made.
pub(crate) fn write_file(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_with(file, |stream| stream.write_all(bytes))
}

/// As [`write_file`], for content that is made as a stream.
pub(crate) fn write_with(
    file: &Path,
    content: impl FnOnce(&mut WholeFile) -> std::io::Result<()>,
) -> Result<(), Failure> {
    let mut whole = WholeFile::create(file)?;
    content(&mut whole).map_err(|e| Failure::system(file, "write", e))?;
    Ok(whole.finish(Durability::InCache)?)
}
