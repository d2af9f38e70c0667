use super::{ArtifactError, Fault, MAGIC, Preamble, Provenance, Schema, checksum, end_mark};
use crate::codec;
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::{NamedTempFile, TempPath};

/// Writes an artifact as a stream to a temporary file beside its place; [`Writer::finish`] renames it there.
///
/// Dropped before `finish`, it leaves nothing behind and an older artifact of the name untouched.
pub struct Writer<S> {
    file: PathBuf,
    stream: BufWriter<File>,
    temporary: Temporary,
    frames: u64,
    schema: PhantomData<S>,
}

impl<S: Schema> Writer<S> {
    /// Opens the stream; folders that are missing are made.
    pub fn create(file: &Path, provenance: &Provenance, header: &S::Header) -> Result<Self, ArtifactError> {
        let temporary = temporary_beside(file).map_err(|f| f.of(file))?;
        let (handle, path) = temporary.into_parts();
        let mut writer = Self {
            file: file.to_owned(),
            stream: BufWriter::new(handle),
            temporary: Temporary::listed(path),
            frames: 0,
            schema: PhantomData,
        };
        let preamble = Preamble { schema: S::NAME.into(), version: S::VERSION, provenance: provenance.clone() };
        writer.raw(MAGIC)?;
        writer.record(None, &preamble)?;
        writer.record(Some(b'H'), header)?;
        Ok(writer)
    }

    /// Appends one frame.
    pub fn write(&mut self, frame: &S::Frame) -> Result<(), ArtifactError> {
        self.record(Some(b'F'), frame)?;
        self.frames += 1;
        Ok(())
    }

    /// Sets the end mark, waits for the disk, and puts the file in its place.
    pub fn finish(mut self) -> Result<(), ArtifactError> {
        self.raw(&end_mark(self.frames))?;
        let file = self.file;
        let handle = self.stream.into_inner().map_err(|e| Fault::system("write")(e.into_error()).of(&file))?;
        handle.sync_all().map_err(|e| Fault::system("write")(e).of(&file))?;
        self.temporary.persist(&file).map_err(|e| Fault::system("rename into place")(e).of(&file))
    }

    fn record<T: serde::Serialize>(&mut self, marker: Option<u8>, value: &T) -> Result<(), ArtifactError> {
        let bytes = codec::encode(value)
            .map_err(|e| Fault::system("encode")(std::io::Error::other(e.to_string())).of(&self.file))?;
        if let Some(marker) = marker {
            self.raw(&[marker])?;
        }
        self.raw(&(bytes.len() as u64).to_le_bytes())?;
        self.raw(&checksum(&bytes))?;
        self.raw(&bytes)
    }

    fn raw(&mut self, bytes: &[u8]) -> Result<(), ArtifactError> {
        self.stream.write_all(bytes).map_err(|e| Fault::system("write")(e).of(&self.file))
    }
}

/// Temporary files of writers that are still open, for a program that is told to stop.
static OPEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn open_files() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    OPEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the temporary files of all open writers: the last act of an interrupted program.
pub fn abandon_all() {
    for file in open_files().iter() {
        let _ = std::fs::remove_file(file);
    }
}

/// A temporary file that is listed while it is open, and removed unless it is persisted.
struct Temporary(Option<TempPath>);

impl Temporary {
    fn listed(path: TempPath) -> Self {
        open_files().insert(path.to_path_buf());
        Self(Some(path))
    }

    fn persist(mut self, place: &Path) -> std::io::Result<()> {
        match self.0.take() {
            Some(path) => {
                open_files().remove::<Path>(&path);
                path.persist(place).map_err(|e| e.error)
            }
            None => Ok(()),
        }
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(path) = &self.0 {
            open_files().remove::<Path>(path);
        }
    }
}

fn temporary_beside(file: &Path) -> Result<NamedTempFile, Fault> {
    let folder = file.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(Fault::system("make the folder"))?;
    let prefix = format!(".{}.", file.file_name().unwrap_or_default().to_string_lossy());
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".part");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666)); // less the umask, as any new file
    builder.tempfile_in(folder).map_err(Fault::system("create"))
}
