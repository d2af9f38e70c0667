//! Files and programs of the system; each error contains the name.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use wayside::host::failure::Failure;

/// Files and folders of a folder.
pub(super) fn entries(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let system = |error| Failure::system(folder, "read", error);
    let listed = std::fs::read_dir(folder).map_err(system)?;
    listed.map(|entry| entry.map(|entry| entry.path()).map_err(system)).collect()
}

/// Copies a file with its permissions into a folder, which is created if missing.
pub(super) fn copy(file: &Path, folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|error| Failure::system(folder, "create", error))?;
    let name = file.file_name().unwrap_or_default();
    std::fs::copy(file, folder.join(name)).map_err(|error| Failure::system(file, "copy", error))?;
    Ok(())
}

/// Standard output of a program that must succeed.
pub(super) fn output(command: &mut Command) -> Result<Vec<u8>, Failure> {
    let name = command.get_program().to_string_lossy().into_owned();
    let ended = command.stdin(Stdio::null()).output();
    let ended = ended.map_err(|error| Failure::System(format!("{name}: {error}")))?;
    if ended.status.success() {
        return Ok(ended.stdout);
    }
    let said = String::from_utf8_lossy(&ended.stderr).trim().to_owned();
    Err(Failure::System(format!("{name}: ended with {}: {said}", ended.status)))
}
