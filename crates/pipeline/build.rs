//! Hashes the sources of each stage, and of the evaluation, together with those of the leaves that it uses,
//! for cache keys: unlike a version number kept by hand, a hash cannot be forgotten.

mod dependencies;
mod sources;

use std::path::{Path, PathBuf};

const HASHED: [&str; 6] = ["scene", "bart-rcs", "fmcw-echo", "dsp", "classifier", "evaluation"];

fn main() {
    // Read at run time: a cached build script from another checkout must not look there.
    let manifest = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
    let root = Path::new(&manifest).join("../..");
    let common =
        ["crates/artifact", "crates/bodies", "crates/radar", "Cargo.lock"].map(|place| root.join(place));
    for stage in HASHED {
        let own = root.join("crates").join(stage);
        let seen = dependencies::of(&root, stage).unwrap_or_else(|error| fail(&format!("{stage}: {error}")));
        let others = seen.into_iter().filter(|leaf| !common.contains(leaf));
        // Tables of both are kept alike.
        let reference = (stage == "bart-rcs").then(|| root.join("crates/po-sbr"));
        let places: Vec<PathBuf> =
            common.iter().cloned().chain([own]).chain(others).chain(reference).collect();
        places.iter().for_each(|place| println!("cargo::rerun-if-changed={}", place.display()));
        let hash = sources::hash_of(&places, std::convert::identity).unwrap_or_else(|error| fail(&error));
        println!("cargo::rustc-env=SOURCES_OF_{}={hash}", stage.replace('-', "_").to_uppercase());
    }
}

/// Ends the build with the sentence of an error.
fn fail(error: &dyn std::fmt::Display) -> ! {
    println!("cargo::error={error}");
    std::process::exit(1);
}
