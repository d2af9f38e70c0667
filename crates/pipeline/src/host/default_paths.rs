//! Default places of data. Inside the project's folder (this folder or one above it that holds `scenes/` and
//! `crates/wayside/`) the cache is its `.cache`; elsewhere it is the user's cache folder, and there is none
//! where the system names no home. The shipped model is part of the program.

use std::path::{Path, PathBuf};

/// The project's folder: `$WAYSIDE_PROJECT`, otherwise found from the process's working folder; `None`
/// outside.
pub fn project_folder() -> Option<PathBuf> {
    if let Some(folder) = std::env::var_os("WAYSIDE_PROJECT").filter(|folder| !folder.is_empty()) {
        return Some(PathBuf::from(folder));
    }
    project_folder_of(&std::env::current_dir().ok()?)
}

fn project_folder_of(here: &Path) -> Option<PathBuf> {
    let is_project =
        |folder: &&Path| folder.join("scenes").is_dir() && folder.join("crates/wayside").is_dir();
    here.ancestors().find(is_project).map(Path::to_owned)
}

/// Default cache folder, which `--cache` overrides; `None` outside the project for a user without a home.
pub(crate) fn default_cache() -> Option<PathBuf> {
    let variable = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let of_user = || variable("XDG_CACHE_HOME").or_else(|| variable("HOME").map(|home| home.join(".cache")));
    project_folder()
        .map(|folder| folder.join(".cache"))
        .or_else(|| of_user().map(|folder| folder.join("wayside")))
}

/// Resolves a path through links; its end need not exist yet.
pub(crate) fn resolved(path: &Path) -> PathBuf {
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let real = |above: &Path| {
        let rest = whole.strip_prefix(above).ok()?;
        Some(std::fs::canonicalize(above).ok()?.join(rest))
    };
    whole.ancestors().find_map(real).unwrap_or_else(|| whole.clone())
}

/// The shipped model (`fixtures/classifier.model`), as it was when the program was built.
#[cfg(feature = "classifier")]
pub(crate) const SHIPPED_MODEL: &[u8] = include_bytes!("../../../../fixtures/classifier.model");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_project_is_found_from_any_folder_below_it_and_nowhere_else() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap();
        assert_eq!(project_folder_of(&root.join("crates/wayside/src")), Some(root.clone()));
        assert_eq!(project_folder_of(&root), Some(root));
        assert_eq!(project_folder_of(tempfile::tempdir().unwrap().path()), None);
    }
}
