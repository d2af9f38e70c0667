//! Check that doc comments are sentences or noun phrases, and readable without neighbouring comments.

use crate::ci::findings::{fail_on, read};
use crate::house::{self, folders};
use crate::project::project_root;
use std::path::Path;
use wayside::host::failure::Failure;
use wayside::program::terminal;

/// Largest share of a crate's doc comments that may begin as fragments.
const MAX_FRAGMENT_SHARE: f64 = 0.02;

/// First words that refer to something outside of the comment; "Whether" describes a `bool`.
const FRAGMENT_BEGINNINGS: &str = "Of To As With Without In At From For By Than On Onto Into Across Along Towards And \
    Or But Nor Also Likewise Else Otherwise Those Them They Their Its It What Where How When Which Who Whose \
    Why So Not";

/// First words that refer to something outside if they are alone or before one of [`DANGLING_NEXT`].
const DANGLING_ALONE: &str = "All Both None Each These Any";

/// Words before which "The same" or one of [`DANGLING_ALONE`] refers to something outside of the comment.
const DANGLING_NEXT: &str =
    "of that as in at to for from by with without where while when who what which less but";

pub(super) fn check() -> Result<(), Failure> {
    let mut broken = Vec::new();
    for folder in house::crates(&project_root())? {
        let (count, found) = fragments_of(&folder)?;
        let (name, share) = (house::crate_name(&folder), found.len() as f64 / count.max(1) as f64);
        let sentence = format!(
            "{name}: {} of {count} doc comments begin as fragments, {:.1} % (at most {:.0} %)",
            found.len(),
            100.0 * share,
            100.0 * MAX_FRAGMENT_SHARE
        );
        terminal::line(&sentence);
        if share > MAX_FRAGMENT_SHARE {
            broken.extend(found.into_iter().chain([sentence]));
        }
    }
    fail_on(broken)
}

/// Number of a crate's doc comments, and a line for each that begins as a fragment.
fn fragments_of(folder: &Path) -> Result<(usize, Vec<String>), Failure> {
    let (mut count, mut found) = (0, Vec::new());
    for file in folders::sources(folder) {
        let text = read(&file)?;
        for (line, first) in comments(&text) {
            count += 1;
            if is_fragment(first) {
                found.push(format!("{}:{line}: begins as a fragment: {first}", file.display()));
            }
        }
    }
    Ok((count, found))
}

/// Line number and first line of each doc comment.
fn comments(text: &str) -> Vec<(usize, &str)> {
    let (mut before, mut found) = (None, Vec::new());
    for (line, number) in text.lines().zip(1..) {
        let comment = documentation(line.trim_start());
        if let Some((kind, first)) = comment.filter(|(kind, _)| before != Some(*kind)) {
            before = Some(kind);
            found.push((number, first.trim()));
        } else if comment.is_none() {
            before = None;
        }
    }
    found
}

/// Marker and content of a line of a doc comment.
fn documentation(line: &str) -> Option<(&str, &str)> {
    let (marker, content) = line.split_at_checked(3)?;
    (matches!(marker, "///" | "//!") && !content.starts_with('/')).then_some((marker, content))
}

/// Whether a comment begins with a word that refers to something outside of it, or in lower case.
fn is_fragment(comment: &str) -> bool {
    let mut words = comment.split_whitespace();
    let [first, second, third] = [0; 3].map(|_| words.next().unwrap_or_default());
    let leans =
        |word: &str, next: &str| word.ends_with(['.', ',', ';', ':']) || is_among(next, DANGLING_NEXT);
    let plain = first.trim_end_matches(['.', ',', ';', ':']);
    match plain {
        "The" => second.trim_end_matches(['.', ',', ';', ':']) == "same" && leans(second, third),
        _ if is_among(plain, DANGLING_ALONE) => leans(first, second),
        _ => is_among(plain, FRAGMENT_BEGINNINGS) || comment.starts_with(char::is_lowercase),
    }
}

fn is_among(word: &str, list: &str) -> bool {
    list.split_whitespace().any(|listed| listed == word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fragments_are_told_from_sentences_and_names() {
        let fragments = [
            "Of one body.",
            "likewise lower case",
            "Likewise.",
            "The same without noise.",
            "The same, by track.",
            "All that were traced.",
            "Both.",
            "What a map shows.",
            "Its index.",
        ];
        assert!(fragments.iter().all(|comment| is_fragment(comment)), "{fragments:?}");
        let good = [
            "The map's range axis, m.",
            "Number of chirps in a frame.",
            "Finds the nearest key.",
            "Whether the radar hears the body.",
            "The same request gives the same bytes.",
            "All paths of a frame.",
            "[`trace`] with a listener.",
            "|a|, m/s².",
        ];
        assert!(!good.iter().any(|comment| is_fragment(comment)), "{good:?}");
    }

    #[test]
    fn a_comment_is_counted_once_with_its_first_line() {
        let text =
            "//! File.\n//! More.\n\n/// One\n/// more.\nfn a() {}\n    /// Two.\n//// none\n// none\n";
        assert_eq!(comments(text), [(1, "File."), (4, "One"), (7, "Two.")]);
    }
}
