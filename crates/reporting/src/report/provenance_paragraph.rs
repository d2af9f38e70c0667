//! Paragraph about the command that made a report, and the files beside it.

use maud::{Markup, html};

/// Files of a run, in the order of the chain, with their contents.
const FILES: [(&str, &str); 9] = [
    ("scene.scene", "scene"),
    ("frames.paths", "paths"),
    ("frames.rcs", "scattering tables"),
    ("frames.cube", "radar cubes"),
    ("frames.rdm", "range-Doppler maps"),
    ("frames.points", "points and objects"),
    ("frames.tracks", "tracks"),
    ("summary.json", "all figures of this page and more"),
    (PICTURES, "of each frame"),
];

/// Folder of pictures, as a page links to it.
pub(super) const PICTURES: &str = "pictures/";

/// Command and program that made a report.
#[derive(Debug, Clone)]
pub struct ReportOrigin {
    /// The command, as a shell reads it back.
    pub command: String,
    /// The program that reads artifacts, as typed.
    pub program: String,
}

impl ReportOrigin {
    /// Describes a program that was called with these words.
    pub fn by(program: &str, words: impl Iterator<Item = String>) -> Self {
        Self { command: command(program, words), program: program.to_owned() }
    }
}

impl Default for ReportOrigin {
    fn default() -> Self {
        Self { command: "wayside::run".into(), program: "wayside".into() }
    }
}

/// The command and links to the files that it wrote: an earlier command may have left others in the same
/// folder.
pub(super) fn origin_paragraph(origin: &ReportOrigin, written: &[&str]) -> Markup {
    let files: Vec<_> = FILES.iter().filter(|(name, _)| written.contains(name)).collect();
    html! {
        p.made {
            "Made by " code { (origin.command) } ". "
            "Files beside this page: "
            @for (number, (name, what)) in files.iter().enumerate() {
                @if number > 0 { ", " }
                a href=(name) { (name) } " (" (what) ")"
            }
            ". Read artifacts with " code { (origin.program) " inspect" }
            " and " code { (origin.program) " export" } "."
        }
    }
}

/// A command line that a shell parses into these words.
fn command(program: &str, words: impl Iterator<Item = String>) -> String {
    let is_plain = |word: &str| {
        !word.is_empty() && word.chars().all(|c| c.is_alphanumeric() || "-_./=:,+@%".contains(c))
    };
    let quoted =
        |word: String| if is_plain(&word) { word } else { format!("'{}'", word.replace('\'', "'\\''")) };
    std::iter::once(program.to_owned()).chain(words.map(quoted)).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_links_to_what_the_command_wrote() {
        let page = origin_paragraph(&ReportOrigin::default(), &["frames.paths", "summary.json", PICTURES])
            .into_string();
        assert_eq!(page.matches("href").count(), 3, "{page}");
        assert!(page.contains("href=\"frames.paths\"") && !page.contains("frames.rcs"), "{page}");
    }

    #[test]
    fn a_command_can_be_typed_again_whatever_its_words_hold() {
        let words = ["run", "my scenes/it's.toml", "--out", "x"].map(str::to_owned);
        assert_eq!(
            command("cargo xtask", words.into_iter()),
            "cargo xtask run 'my scenes/it'\\''s.toml' --out x"
        );
    }
}
