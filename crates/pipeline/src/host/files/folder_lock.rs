//! A folder of results that only one command fills at a time.

use super::claimed_paths::{canonical_name, claimed_paths};
use crate::host::failure::Failure;
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};

/// A command that writes into a folder: it writes no file twice, and no other command writes there meanwhile.
/// After its end, a later one may write the same files again.
///
/// The folder itself is locked: the lock ends with its process, however that ends, and leaves nothing behind.
/// Where the system cannot open folders or the file system has no locks, only the commands of this process
/// exclude each other.
pub struct FolderLock {
    folder: PathBuf,
    lock: Option<File>,
}

impl FolderLock {
    /// Begins to write into a folder, which is created if missing.
    ///
    /// # Errors
    /// Another command, of this process or another one, is writing there.
    pub fn acquire(folder: &Path) -> Result<Self, Failure> {
        let writing = Self::of_process(folder)?;
        match writing.lock.as_ref().map(File::try_lock) {
            Some(Err(TryLockError::WouldBlock)) => Err(refused(&writing.folder)),
            _ => Ok(writing),
        }
    }

    /// Begins to write into a folder as [`FolderLock::acquire`] does, but waits for other processes that
    /// write there: parts of one study, each of which may be the last.
    pub fn wait_for(folder: &Path) -> Result<Self, Failure> {
        let writing = Self::of_process(folder)?;
        if let Some(lock) = &writing.lock {
            let _ = lock.lock(); // without locks there is nothing to wait for
        }
        Ok(writing)
    }

    /// Reserves the folder within this process, and opens it for locking where the system can.
    fn of_process(folder: &Path) -> Result<Self, Failure> {
        let folder = std::path::absolute(folder).map_err(|e| Failure::system(folder, "write", e))?;
        std::fs::create_dir_all(&folder).map_err(|e| Failure::system(&folder, "make the folder", e))?;
        if !claimed_paths().folders.insert(canonical_name(&folder)) {
            return Err(refused(&folder));
        }
        let lock = File::open(&folder).ok();
        Ok(Self { folder, lock })
    }
}

fn refused(folder: &Path) -> Failure {
    let rule = "is being written by another run of this program";
    Failure::System(format!("{}: {rule}", folder.display()))
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        let mut claimed_paths = claimed_paths();
        // A folder that did not exist at the beginning can be resolved now.
        for name in [canonical_name(&self.folder), self.folder.clone()] {
            claimed_paths.folders.remove(&name);
            claimed_paths.files.retain(|file| !file.starts_with(&name));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_that_a_run_writes_into_is_refused_to_another_run_until_it_ends() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        let first = FolderLock::acquire(&out).unwrap();
        let refused = FolderLock::acquire(&folder.path().join("out/../out")).err().unwrap().to_string();
        assert!(refused.contains("out: is being written by another run of this program"), "{refused}");
        drop(FolderLock::acquire(folder.path()).unwrap());
        drop(first);
        drop(FolderLock::acquire(&out).unwrap());
    }

    #[cfg(unix)]
    #[test]
    fn a_folder_that_another_process_writes_into_is_refused_until_that_one_ends() {
        let folder = tempfile::tempdir().unwrap();
        // Another open file of the folder stands for another process: locks are of open files.
        let other = File::open(folder.path()).unwrap();
        other.lock().unwrap();
        assert!(FolderLock::acquire(folder.path()).is_err());
        drop(other);
        drop(FolderLock::wait_for(folder.path()).unwrap());
        drop(FolderLock::acquire(folder.path()).unwrap());
    }
}
