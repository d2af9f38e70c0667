//! Hash of source files, for cache keys (`build.rs`) and for the age of the pages of `docs/` (`xtask`).

use std::fmt;
use std::path::{Path, PathBuf};

/// Hash of what counts of all sources at these places, one after the other.
pub(crate) fn hash_of<'a>(
    places: impl IntoIterator<Item = &'a PathBuf>,
    counts: impl Fn(Vec<u8>) -> Vec<u8>,
) -> Result<blake3::Hash, SourceError> {
    let mut hasher = blake3::Hasher::new();
    for place in places {
        for file in sources(place)? {
            let bytes = std::fs::read(&file).map_err(SourceError::at(&file))?;
            hasher.update(file.file_name().unwrap_or_default().as_encoded_bytes()).update(&counts(bytes));
        }
    }
    Ok(hasher.finalize())
}

/// A source, or a folder of sources, that cannot be read.
#[derive(Debug)]
pub(crate) struct SourceError {
    place: PathBuf,
    cause: std::io::Error,
}

impl SourceError {
    fn at(place: &Path) -> impl FnOnce(std::io::Error) -> Self {
        |cause| Self { place: place.to_owned(), cause }
    }
}

impl fmt::Display for SourceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place.display(), self.cause)
    }
}

impl std::error::Error for SourceError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.cause)
    }
}

/// The file itself, or all `.rs` and `.toml` files below the folder except tests, in a fixed order.
fn sources(place: &Path) -> Result<Vec<PathBuf>, SourceError> {
    if place.is_file() {
        return Ok(vec![place.to_owned()]);
    }
    let entries = std::fs::read_dir(place).map_err(SourceError::at(place))?;
    let mut entries: Vec<PathBuf> = entries.flatten().map(|e| e.path()).filter(|p| is_source(p)).collect();
    entries.sort();
    let mut all = Vec::new();
    for entry in entries {
        all.extend(sources(&entry)?);
    }
    Ok(all)
}

fn is_source(path: &Path) -> bool {
    let name = path.file_name().and_then(|n| n.to_str()).unwrap_or_default();
    if path.is_dir() {
        return !matches!(name, "tests" | "benches" | "examples") && !name.starts_with('.');
    }
    name.ends_with(".rs") || name.ends_with(".toml")
}
