//! Atomic writing of files, whole or not at all, and reading of files that earlier runs left.

mod claimed_paths;
mod folder_lock;

use crate::host::failure::Failure;
use artifact::ArtifactError;
use artifact::atomic_file::{self, AtomicFile, Durability};
use claimed_paths::{canonical_name, claimed_paths};
use std::collections::BTreeSet;
use std::io::{Error, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

pub use folder_lock::FolderLock;

/// Refuses unwritable results before the work begins: no plain file, an input, a place without permission, or
/// one place for two results.
pub fn claim(places: &[PathBuf]) -> Result<(), Failure> {
    let mut claimed = BTreeSet::new();
    for place in places {
        atomic_file::check(place)?;
        if !claimed.insert(canonical_name(place)) {
            return Err(twice(place));
        }
    }
    Ok(())
}

/// Refuses, before the work, to replace a file that the user did not name and that no earlier run of this
/// program left: larger than `limit` bytes, or with foreign content.
pub fn refuse_foreign(place: &Path, limit: u64, is_own: impl FnOnce(&[u8]) -> bool) -> Result<(), Failure> {
    let rule = "was not written by this program, and would be replaced";
    refuse_unless(place, rule, || read_own(place, limit).is_ok_and(|bytes| is_own(&bytes)))
}

/// Refuses, as [`refuse_foreign`], by the first kilobyte of the file. An empty one is own: earlier results
/// are emptied where their names are symbolic links.
pub fn refuse_foreign_head(place: &Path, is_own: impl FnOnce(&[u8]) -> bool) -> Result<(), Failure> {
    let rule = "was not written by this program, and would be replaced";
    refuse_unless(place, rule, || {
        let mut head = Vec::new();
        let read = std::fs::File::open(place).and_then(|file| file.take(1024).read_to_end(&mut head));
        read.is_ok() && (head.is_empty() || is_own(&head))
    })
}

/// Refuses, as [`refuse_foreign`], to replace a file that is no artifact.
pub fn refuse_no_artifact(place: &Path) -> Result<(), Failure> {
    refuse_foreign_head(place, |head| head.starts_with(artifact::envelope::MAGIC))
}

/// Refuses, before the work, to replace a plain file that the user did not name unless `may_be` allows it;
/// `rule` is the text of the refusal. A place that is neither missing nor a plain file is refused by its
/// writer.
pub fn refuse_unless(place: &Path, rule: &str, may_be: impl FnOnce() -> bool) -> Result<(), Failure> {
    if !place.is_file() || may_be() {
        return Ok(());
    }
    Err(Failure::System(format!("{}: {rule}; choose another --out", place.display())))
}

/// Writes `file` whole or not at all; missing folders are created.
pub fn write_file(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_with(file, |stream| stream.write_all(bytes))
}

/// Reads a file that an earlier run left and this one may replace; it does not count as an input. Refuses
/// files that are not plain or larger than `limit` bytes.
pub fn read_own(file: &Path, limit: u64) -> std::io::Result<Vec<u8>> {
    // Opening a FIFO would wait for its writer.
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

/// Writes a file that grows and is rewritten repeatedly, whole or not at all.
pub fn overwrite(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let mut whole = AtomicFile::create(file)?;
    whole.write_all(bytes).map_err(|e| Failure::system(file, "write", e))?;
    Ok(whole.finish(Durability::InCache)?)
}

/// Removes the results of earlier commands in these places before the first is written anew: an interrupted
/// command then leaves fewer files, and never a mixture of new and old ones.
pub fn remove_outdated(places: impl IntoIterator<Item = PathBuf>) -> Result<(), Failure> {
    for place in places {
        // The writer reports a place that cannot be replaced.
        if place.is_file() {
            atomic_file::check(&place)?;
            remove_description(&place, &[]).map_err(|e| Failure::system(&place, "remove", e))?;
        }
    }
    Ok(())
}

/// Removes a file that describes another one, before that one is replaced; a symbolic link stays, and its
/// target is overwritten with `nothing_told`.
pub fn remove_description(file: &Path, nothing_told: &[u8]) -> std::io::Result<()> {
    match std::fs::symlink_metadata(file) {
        Err(e) if e.kind() == ErrorKind::NotFound => Ok(()),
        Ok(about) if about.is_symlink() => overwrite(file, nothing_told).map_err(Error::other),
        Ok(_) => std::fs::remove_file(file),
        Err(e) => Err(e),
    }
}

/// Writes a file from a stream, whole or not at all. An [`ArtifactError`] of the content is returned
/// unchanged: the input is at fault, not the output.
pub fn write_with(
    file: &Path,
    content: impl FnOnce(&mut AtomicFile) -> std::io::Result<()>,
) -> Result<(), Failure> {
    write(file, Durability::InCache, content)
}

/// Writes a file as [`write_with`] does and waits for the disk: for results of hours of work whose
/// checkpoints are removed next.
pub fn write_durably(
    file: &Path,
    content: impl FnOnce(&mut AtomicFile) -> std::io::Result<()>,
) -> Result<(), Failure> {
    write(file, Durability::OnDisk, content)
}

/// Lets later work of this process write these results again: that of a command ends with the process, that
/// of a program which holds the library does not.
pub fn release(places: &[PathBuf]) {
    let mut claimed_paths = claimed_paths();
    for place in places {
        claimed_paths.files.remove(&canonical_name(place));
    }
}

fn write(
    file: &Path,
    durability: Durability,
    content: impl FnOnce(&mut AtomicFile) -> std::io::Result<()>,
) -> Result<(), Failure> {
    let mut whole = AtomicFile::create(file)?;
    content(&mut whole).map_err(|e| match e.downcast::<ArtifactError>() {
        Ok(of_source) => of_source.into(),
        Err(e) => Failure::system(file, "write", e),
    })?;
    if !claimed_paths().files.insert(canonical_name(file)) {
        return Err(twice(file));
    }
    Ok(whole.finish(durability)?)
}

fn twice(place: &Path) -> Failure {
    Failure::System(format!(
        "{}: cannot be written: two results of this command have this name",
        place.display()
    ))
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

    #[test]
    fn a_run_writes_no_file_twice_and_the_next_one_writes_the_same_files_again() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("new/out");
        for _ in 0..2 {
            let writing = FolderLock::acquire(&out).unwrap();
            write_file(&out.join("a"), b"a").unwrap();
            assert!(write_file(&out.join("a"), b"b").unwrap_err().to_string().contains("two results"));
            drop(writing);
        }
        assert_eq!(std::fs::read(out.join("a")).unwrap(), b"a");
    }

    #[test]
    fn results_that_were_released_are_written_again() {
        let folder = tempfile::tempdir().unwrap();
        let places = ["a", "b"].map(|name| folder.path().join(name));
        places.iter().for_each(|place| write_file(place, b"1").unwrap());
        release(&places[..1]);
        write_file(&places[0], b"2").unwrap();
        assert!(write_file(&places[1], b"2").unwrap_err().to_string().contains("two results"));
        assert_eq!(std::fs::read(&places[0]).unwrap(), b"2");
    }

    #[test]
    fn results_that_are_outdated_are_gone_and_what_is_none_of_a_writers_stays() {
        let folder = tempfile::tempdir().unwrap();
        let place = |name: &str| folder.path().join(name);
        std::fs::write(place("old"), "old").unwrap();
        std::fs::create_dir(place("folder")).unwrap();
        remove_outdated(["old", "none", "folder"].map(place)).unwrap();
        assert!(!place("old").exists() && place("folder").is_dir());
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
