//! The hash of source files: by `build.rs` for cache keys, by `xtask` for the age of the pages of `docs/`.

use std::path::{Path, PathBuf};

/// Of all sources at these places, one after the other; a sentence where one cannot be read.
pub(crate) fn hash_of<'a>(places: impl IntoIterator<Item = &'a PathBuf>) -> Result<blake3::Hash, String> {
    let mut hasher = blake3::Hasher::new();
    for place in places {
        for file in sources(place)? {
            let bytes = std::fs::read(&file).map_err(|e| format!("{}: {e}", file.display()))?;
            hasher.update(file.file_name().unwrap_or_default().as_encoded_bytes()).update(&bytes);
        }
    }
    Ok(hasher.finalize())
}

/// The file itself, or all `.rs` and `.toml` files below the folder but tests, in a fixed order.
fn sources(place: &Path) -> Result<Vec<PathBuf>, String> {
    if place.is_file() {
        return Ok(vec![place.to_owned()]);
    }
    let entries = std::fs::read_dir(place).map_err(|e| format!("{}: {e}", place.display()))?;
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
