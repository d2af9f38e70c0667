//! Places of the project's source.

use std::path::{Path, PathBuf};
use wayside::host::failure::Failure;

/// The project's folder: `$WAYSIDE_PROJECT`, else the root of the workspace that this program was built from,
/// as long as it is still there, else this folder.
pub(crate) fn project_root() -> PathBuf {
    if let Some(folder) = std::env::var_os("WAYSIDE_PROJECT").filter(|folder| !folder.is_empty()) {
        return PathBuf::from(folder);
    }
    let built_in = Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(Path::to_owned);
    built_in.filter(|p| p.join("Cargo.toml").is_file()).unwrap_or_else(|| PathBuf::from("."))
}

/// Text of a plain file that a user names.
pub(crate) fn read_text(file: &Path) -> Result<String, Failure> {
    artifact::bounded::read_text(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))
}

/// Largest file, far beyond the longest table of a study.
const LIMIT_BYTES: u64 = 256 << 20;

/// Files of third parties, beside the project.
pub(crate) fn shared() -> PathBuf {
    std::env::var_os("WAYSIDE_SHARED").map_or_else(|| project_root().join("../shared"), PathBuf::from)
}

/// Suffix that Linux appends to the path of a running program whose file was removed.
const REMOVED: &str = " (deleted)";

/// This program, which carries out the commands of `wayside` too; if it was rebuilt while running, the new
/// one in its place.
pub(crate) fn this_program() -> Result<PathBuf, Failure> {
    let place = std::env::current_exe().map_err(|e| Failure::System(format!("this program: {e}")))?;
    Ok(rebuilt_program(place))
}

fn rebuilt_program(place: PathBuf) -> PathBuf {
    let built_anew = place.to_str().and_then(|place| place.strip_suffix(REMOVED)).map(PathBuf::from);
    built_anew.filter(|anew| !place.exists() && anew.is_file()).unwrap_or(place)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_built_anew_is_found_in_its_place() {
        let folder = tempfile::tempdir().unwrap();
        let [program, removed] = ["xtask", "xtask (deleted)"].map(|name| folder.path().join(name));
        assert_eq!(rebuilt_program(removed.clone()), removed, "nothing was built in its place");
        std::fs::write(&program, "anew").unwrap();
        assert_eq!(rebuilt_program(removed.clone()), program);
        assert_eq!(rebuilt_program(program.clone()), program);
        std::fs::write(&removed, "a name of its own").unwrap();
        assert_eq!(rebuilt_program(removed.clone()), removed);
    }
}
