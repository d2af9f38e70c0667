//! What made a report, and what lies beside it.

use maud::{Markup, html};
use std::path::Path;

/// Artifacts and tables that a run leaves, in the order of the chain, with what they hold.
const FILES: [(&str, &str); 8] = [
    ("scene.scene", "scene"),
    ("frames.paths", "paths"),
    ("frames.rcs", "scattering tables"),
    ("frames.cube", "radar cubes"),
    ("frames.rdm", "range-Doppler maps"),
    ("frames.points", "points and objects"),
    ("frames.tracks", "tracks"),
    ("summary.json", "all figures of this page and more"),
];

/// The command of this process and links to the files of `out` that are there.
pub(super) fn made(out: &Path) -> Markup {
    let files: Vec<_> = FILES.iter().filter(|(name, _)| out.join(name).exists()).collect();
    let pictures = out.join("pictures").exists();
    html! {
        p.made {
            "Made by " code { (command(std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned()))) } ". "
            "Beside this page: "
            @for (number, (name, what)) in files.iter().enumerate() {
                @if number > 0 { ", " }
                a href=(name) { (name) } " (" (what) ")"
            }
            @if pictures { ", " a href="pictures/" { "pictures/" } }
            ". Artifacts are read by " code { "cargo xtask inspect" } " and " code { "cargo xtask export" } "."
        }
    }
}

/// A command line that a shell reads back as these words.
fn command(words: impl Iterator<Item = String>) -> String {
    let is_plain =
        |word: &str| !word.is_empty() && word.chars().all(|c| c.is_alphanumeric() || "-_./=:,+@%".contains(c));
    let quoted = |word: String| if is_plain(&word) { word } else { format!("'{}'", word.replace('\'', "'\\''")) };
    std::iter::once("cargo xtask".to_owned()).chain(words.map(quoted)).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_can_be_typed_again_whatever_its_words_hold() {
        let words = ["run", "my scenes/it's.toml", "--out", "x"].map(str::to_owned);
        assert_eq!(command(words.into_iter()), "cargo xtask run 'my scenes/it'\\''s.toml' --out x");
    }
}
