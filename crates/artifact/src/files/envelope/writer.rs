use crate::files::atomic_file::{AtomicFile, Durability};
use crate::files::codec;
use crate::files::envelope::{ArtifactError, Fault, MAGIC, Preamble, Provenance, Schema, checksum, end_mark};
use std::io::Write;
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

/// Writes an artifact as a stream to a temporary file beside its destination; [`Writer::finish`] renames it.
///
/// If dropped before `finish`, it leaves nothing behind and an older artifact of that name untouched.
pub struct Writer<S> {
    file: PathBuf,
    stream: AtomicFile,
    frames: u64,
    schema: PhantomData<S>,
}

impl<S: Schema> Writer<S> {
    /// Opens the stream; missing folders are created.
    pub fn create(file: &Path, provenance: &Provenance, header: &S::Header) -> Result<Self, ArtifactError> {
        let stream = AtomicFile::create(file)?;
        let mut writer = Self { file: file.to_owned(), stream, frames: 0, schema: PhantomData };
        let preamble =
            Preamble { schema: S::NAME.into(), version: S::VERSION, provenance: provenance.clone() };
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

    /// Writes the end mark, waits for the disk, and renames the file to its destination.
    pub fn finish(mut self) -> Result<(), ArtifactError> {
        self.raw(&end_mark(self.frames))?;
        self.stream.finish(Durability::OnDisk)
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
