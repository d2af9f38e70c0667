//! Writing of files that are there whole or not at all, and reading of what earlier runs have left.

use crate::host::failure::Failure;
use artifact::whole_file::{self, Durability, WholeFile};
use std::collections::BTreeSet;
use std::io::{Error, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Refuses what could not be written, before the work that it is the result of: no plain file, an input, a
/// place without permission, or one place for two results.
pub fn claim(places: &[PathBuf]) -> Result<(), Failure> {
    let mut claimed = BTreeSet::new();
    for place in places {
        whole_file::check(place)?;
        if !claimed.insert(one_name(place)) {
            return Err(twice(place));
        }
    }
    Ok(())
}

/// Writes `file` whole or not at all; folders that are missing are made.
pub fn write_file(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_with(file, |stream| stream.write_all(bytes))
}

/// Bytes of a file that an earlier run has left and this one may replace: it is no input. What is no plain
/// file and what has more than `limit` bytes is not read.
pub(crate) fn read_own(file: &Path, limit: u64) -> std::io::Result<Vec<u8>> {
    // Opening a FIFO waits for its writer.
    if !std::fs::metadata(file)?.is_file() {
        return Err(Error::new(ErrorKind::InvalidInput, "it is no plain file"));
    }
    let mut bytes = Vec::new();
    std::fs::File::open(file)?.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        return Err(Error::new(ErrorKind::FileTooLarge, format!("it has more than {limit} bytes")));
    }
    Ok(bytes)
}

/// Writes a file that grows and is written again and again, whole or not at all.
pub fn write_again(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let mut whole = WholeFile::create(file)?;
    whole.write_all(bytes).map_err(|e| Failure::system(file, "write", e))?;
    Ok(whole.finish(Durability::InCache)?)
}

/// Writes a file whose content is made as a stream, whole or not at all.
pub(crate) fn write_with(
    file: &Path,
    content: impl FnOnce(&mut WholeFile) -> std::io::Result<()>,
) -> Result<(), Failure> {
    write(file, Durability::InCache, content)
}

/// Writes a file as [`write_with`] does and waits for the disk: what took hours, and what they were kept in
/// until now is removed next.
pub(crate) fn write_lasting(
    file: &Path,
    content: impl FnOnce(&mut WholeFile) -> std::io::Result<()>,
) -> Result<(), Failure> {
    write(file, Durability::OnDisk, content)
}

fn write(
    file: &Path,
    durability: Durability,
    content: impl FnOnce(&mut WholeFile) -> std::io::Result<()>,
) -> Result<(), Failure> {
    let mut whole = WholeFile::create(file)?;
    content(&mut whole).map_err(|e| Failure::system(file, "write", e))?;
    if !WRITTEN.lock().unwrap_or_else(PoisonError::into_inner).insert(one_name(file)) {
        return Err(twice(file));
    }
    Ok(whole.finish(durability)?)
}

/// Files that this command has written.
static WRITTEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn twice(place: &Path) -> Failure {
    Failure::System(format!(
        "{}: cannot be written: two results of this command have this name",
        place.display()
    ))
}

/// Name that all ways to a file share, where its folder exists.
fn one_name(place: &Path) -> PathBuf {
    let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match (std::fs::canonicalize(place), std::fs::canonicalize(folder), place.file_name()) {
        (Ok(whole), _, _) => whole,
        (_, Ok(folder), Some(name)) => folder.join(name),
        _ => place.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_an_earlier_run_left_is_read_up_to_its_limit_and_may_be_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("left");
        std::fs::write(&place, b"abc").unwrap();
        assert_eq!(read_own(&place, 3).unwrap(), b"abc");
        assert_eq!(read_own(&place, 2).unwrap_err().kind(), ErrorKind::FileTooLarge);
        claim(&[place]).unwrap();
        assert_eq!(read_own(folder.path(), 3).unwrap_err().kind(), ErrorKind::InvalidInput);
    }

    #[cfg(unix)]
    #[test]
    fn a_fifo_in_the_place_of_what_an_earlier_run_left_is_not_waited_for() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("left");
        assert!(std::process::Command::new("mkfifo").arg(&place).status().unwrap().success());
        assert_eq!(read_own(&place, 3).unwrap_err().kind(), ErrorKind::InvalidInput);
    }
}
