//! Hashes the sources of each stage together with those of the leaves that it sees, for cache keys: a
//! hand-kept version number is forgotten, a hash is not.

use std::path::{Path, PathBuf};

const STAGES: [&str; 5] = ["scene", "bart-rcs", "fmcw-echo", "dsp", "classifier"];

fn main() {
    // Read when it runs: a build script kept from another checkout must not look there.
    let manifest = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
    let root = Path::new(&manifest).join("../..");
    let common = [root.join("crates/artifact"), root.join("crates/radar"), root.join("Cargo.lock")];
    for stage in STAGES {
        let own = root.join("crates").join(stage);
        let hash = hash_of(common.iter().chain([&own]));
        println!("cargo::rustc-env=SOURCES_OF_{}={hash}", stage.replace('-', "_").to_uppercase());
    }
}

fn hash_of<'a>(places: impl Iterator<Item = &'a PathBuf>) -> String {
    let mut hasher = blake3::Hasher::new();
    for place in places {
        println!("cargo::rerun-if-changed={}", place.display());
        for file in sources(place) {
            let bytes = std::fs::read(&file).unwrap_or_else(|e| fail(&file, &e));
            hasher.update(file.file_name().unwrap_or_default().as_encoded_bytes()).update(&bytes);
        }
    }
    hasher.finalize().to_hex().to_string()
}

/// The file itself, or all `.rs` and `.toml` files below the folder but tests, in a fixed order.
fn sources(place: &Path) -> Vec<PathBuf> {
    if place.is_file() {
        return vec![place.to_owned()];
    }
    let entries = std::fs::read_dir(place).unwrap_or_else(|e| fail(place, &e));
    let mut entries: Vec<PathBuf> = entries.flatten().map(|e| e.path()).collect();
    entries.sort();
    entries.into_iter().filter(|p| is_source(p)).flat_map(|p| sources(&p)).collect()
}

/// Ends the build with a sentence.
fn fail(place: &Path, error: &std::io::Error) -> ! {
    println!("cargo::error={}: {error}", place.display());
    std::process::exit(1);
}

fn is_source(path: &Path) -> bool {
    let name = path.file_name().and_then(|n| n.to_str()).unwrap_or_default();
    if path.is_dir() {
        return !matches!(name, "tests" | "benches" | "examples") && !name.starts_with('.');
    }
    name.ends_with(".rs") || name.ends_with(".toml")
}
