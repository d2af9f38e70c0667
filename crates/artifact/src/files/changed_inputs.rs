//! Detection of changed input files: the hash that names each file in provenance and keys, and whether the
//! file is still the one that was hashed. An editor or exporter may replace a file after it was hashed, so
//! later reads may see other content.

use crate::files::inputs::named_hash;
use std::fs::Metadata;
use std::io::Result;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// A file at the time it was hashed.
#[derive(Debug, Clone)]
pub struct HashedFile {
    file: PathBuf,
    stamp: Stamp,
    named: (String, String),
}

impl HashedFile {
    /// Hashes a file.
    ///
    /// # Errors
    /// The file is unreadable or not plain.
    pub fn of(file: &Path) -> Result<Self> {
        let stamp = Stamp::of(file)?; // before the hash: what changes while it is taken is seen later
        Ok(Self { file: file.to_owned(), stamp, named: named_hash(file)? })
    }

    /// Path of the file.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// Name and hash, as returned by [`named_hash`].
    pub fn named(&self) -> &(String, String) {
        &self.named
    }

    /// Whether the content is unchanged; if the metadata cannot prove it, the file is hashed again and, if it
    /// is the same, its current times are adopted.
    ///
    /// # Errors
    /// Those of [`HashedFile::of`].
    pub fn is_unchanged(&mut self) -> Result<bool> {
        let now = Stamp::of(&self.file)?;
        if self.stamp.is_settled && now.fingerprint == self.stamp.fingerprint {
            return Ok(true);
        }
        let is_same = named_hash(&self.file)?.1 == self.named.1;
        if is_same {
            self.stamp = now;
        }
        Ok(is_same)
    }
}

/// Age below which a file's times prove nothing: they are coarse on some file systems, so a second write may
/// have the same time.
const SETTLED: Duration = Duration::from_secs(3);

/// Fingerprint of a file from its metadata, without its content.
#[derive(Debug, Clone)]
struct Stamp {
    fingerprint: Fingerprint,
    /// Whether the last write is old enough that another one would change the times.
    is_settled: bool,
}

impl Stamp {
    fn of(file: &Path) -> Result<Self> {
        let about = std::fs::metadata(file)?;
        let age = about.modified().ok().and_then(|written| SystemTime::now().duration_since(written).ok());
        Ok(Self { fingerprint: fingerprint(&about), is_settled: age.is_some_and(|age| age > SETTLED) })
    }
}

/// Device, file number, length, and times of the last change of content and of metadata.
#[cfg(unix)]
type Fingerprint = [i128; 7];

#[cfg(unix)]
fn fingerprint(about: &Metadata) -> Fingerprint {
    use std::os::unix::fs::MetadataExt;
    let [mtime, ctime] = [[about.mtime(), about.mtime_nsec()], [about.ctime(), about.ctime_nsec()]];
    [
        about.dev().into(),
        about.ino().into(),
        about.len().into(),
        mtime[0].into(),
        mtime[1].into(),
        ctime[0].into(),
        ctime[1].into(),
    ]
}

/// Length and time of the last write.
#[cfg(not(unix))]
type Fingerprint = (u64, Option<SystemTime>);

#[cfg(not(unix))]
fn fingerprint(about: &Metadata) -> Fingerprint {
    (about.len(), about.modified().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Writes a file with its times set back by an hour.
    fn write(file: &Path, text: &str) {
        std::fs::write(file, text).unwrap();
        let hour_ago = SystemTime::now() - Duration::from_secs(3600);
        std::fs::File::options().write(true).open(file).unwrap().set_modified(hour_ago).unwrap();
    }

    #[test]
    fn a_file_of_the_same_content_is_unchanged_whoever_wrote_it_last() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("m.obj");
        write(&file, "one");
        let mut seen = HashedFile::of(&file).unwrap();
        assert!(seen.is_unchanged().unwrap() && seen.stamp.is_settled);
        std::fs::write(&file, "one").unwrap();
        assert!(seen.is_unchanged().unwrap(), "its time is another");
        write(&file, "one");
        assert!(seen.is_unchanged().unwrap() && seen.stamp.is_settled);
        std::fs::write(&file, "two").unwrap();
        assert!(!seen.is_unchanged().unwrap(), "its length is the same");
        std::fs::remove_file(&file).unwrap();
        assert!(seen.is_unchanged().is_err());
    }

    #[test]
    fn a_file_written_just_before_is_read_again() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("m.obj");
        std::fs::write(&file, "one").unwrap();
        let mut seen = HashedFile::of(&file).unwrap();
        std::fs::write(&file, "two").unwrap(); // perhaps at the same time, as the system tells it
        assert!(!seen.is_unchanged().unwrap() && !seen.stamp.is_settled);
    }

    #[cfg(unix)]
    #[test]
    fn another_file_of_the_same_length_and_time_is_seen() {
        let folder = tempfile::tempdir().unwrap();
        let (file, other) = (folder.path().join("m.obj"), folder.path().join("other"));
        write(&file, "one");
        let mut seen = HashedFile::of(&file).unwrap();
        let written = std::fs::metadata(&file).unwrap().modified().unwrap();
        write(&other, "two");
        std::fs::File::options().write(true).open(&other).unwrap().set_modified(written).unwrap();
        std::fs::rename(&other, &file).unwrap();
        assert!(!seen.is_unchanged().unwrap());
    }
}
