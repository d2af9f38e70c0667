//! Results on standard output, and whole files or none.

use crate::failure::Failure;
use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// A line of results. A reader that has gone away (`| head`) ends the program quietly.
pub(crate) fn line(text: impl std::fmt::Display) {
    if writeln!(std::io::stdout(), "{text}").is_err() {
        std::process::exit(0);
    }
}

/// Names of temporary files that are being written.
static OPEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Removes temporary files that are being written: the last act of an interrupted program.
pub(crate) fn abandon_all() {
    for file in OPEN.lock().unwrap_or_else(PoisonError::into_inner).iter() {
        let _ = std::fs::remove_file(file);
    }
}

/// Writes `file` whole or not at all; folders that are missing are made.
pub(crate) fn write_file(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_with(file, |stream| stream.write_all(bytes))
}

/// As [`write_file`], for content that is made as a stream.
pub(crate) fn write_with(
    file: &Path,
    content: impl FnOnce(&mut std::io::BufWriter<&mut std::fs::File>) -> std::io::Result<()>,
) -> Result<(), Failure> {
    let folder = file.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let failed = |e: std::io::Error| Failure::system(file, "write", e);
    std::fs::create_dir_all(folder).map_err(failed)?;
    let mut temporary = temporary_in(folder, file).map_err(failed)?;
    let listed = temporary.path().to_owned();
    OPEN.lock().unwrap_or_else(PoisonError::into_inner).insert(listed.clone());
    let mut stream = std::io::BufWriter::new(temporary.as_file_mut());
    let written = content(&mut stream).and_then(|()| stream.flush());
    drop(stream);
    OPEN.lock().unwrap_or_else(PoisonError::into_inner).remove(&listed);
    written.map_err(failed)?;
    temporary.persist(file).map(drop).map_err(|e| failed(e.error))
}

fn temporary_in(folder: &Path, file: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    let prefix = format!(".{}.", file.file_name().unwrap_or_default().to_string_lossy());
    builder.prefix(&prefix).suffix(".part");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666)); // less the umask, as any new file
    builder.tempfile_in(folder)
}
