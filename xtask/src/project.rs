//! Places of the project's source.

use std::path::{Path, PathBuf};

/// The root of the workspace that this program was built from, as long as it is still there, else this
/// folder.
pub(crate) fn project_root() -> PathBuf {
    let built_in = Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(Path::to_owned);
    built_in.filter(|p| p.join("Cargo.toml").is_file()).unwrap_or_else(|| PathBuf::from("."))
}
