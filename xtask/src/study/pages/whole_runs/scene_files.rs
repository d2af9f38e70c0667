//! Texts of the files of `scenes/`, with other values of some keys.

use crate::project::project_root;
use std::fmt::Display;
use std::path::PathBuf;
use wayside::host::failure::Failure;

/// Place of a file of `scenes/`.
pub(in crate::study::pages) fn place_of(name: &str) -> PathBuf {
    project_root().join("scenes").join(format!("{name}.toml"))
}

/// Text of a file of `scenes/`; the files that it names are absolute, so that it is a scene in any folder.
pub(in crate::study::pages) fn text_of(name: &str) -> Result<String, Failure> {
    let (root, file) = (project_root(), place_of(name));
    let text = std::fs::read_to_string(&file).map_err(|e| Failure::system(&file, "read", e))?;
    let (scenes, fixtures) = (root.join("scenes"), root.join("fixtures"));
    Ok(text
        .replace("\"vehicles.", &format!("\"{}/vehicles.", scenes.display()))
        .replace("\"../fixtures/", &format!("\"{}/", fixtures.display())))
}

/// The scene file with this value of a key, whose earlier value goes; a table without a name is that of the
/// scene itself.
pub(in crate::study::pages) fn with_key(text: &str, table: &str, key: &str, value: impl Display) -> String {
    let (others, head, line) = (without_key(text, key), format!("[{table}]\n"), format!("{key} = {value}\n"));
    match table {
        "" => format!("{line}{others}"),
        _ if others.contains(&head) => others.replacen(&head, &format!("{head}{line}"), 1),
        _ => format!("{others}\n{head}{line}"),
    }
}

/// The scene file without a key, in whichever table it is.
pub(in crate::study::pages) fn without_key(text: &str, key: &str) -> String {
    let is_kept = |line: &&str| line.split('=').next().is_none_or(|name| name.trim() != key);
    text.lines().filter(is_kept).flat_map(|line| [line, "\n"]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_has_its_new_value_alone_and_in_its_table() {
        let text = "seed = 1\n[fidelity]\naccuracy_db = -10.0\nbounces = 3   # three\n[dsp]\n";
        let once = with_key(text, "fidelity", "bounces", 1);
        assert_eq!(once, "seed = 1\n[fidelity]\nbounces = 1\naccuracy_db = -10.0\n[dsp]\n");
        assert_eq!(without_key(&once, "bounces"), text.replace("bounces = 3   # three\n", ""));
        assert!(with_key(text, "", "seed", 2).starts_with("seed = 2\n[fidelity]\n"));
        assert!(
            with_key(text, "traffic", "begin_s", "32.0").ends_with("[dsp]\n\n[traffic]\nbegin_s = 32.0\n")
        );
    }
}
