//! Parts of pages that studies make: a part between two lines that name it, the first of them with the hash
//! of the sources that made it; or a whole page, with that line as its last one.

use std::ops::Range;

/// A page beside the sources that its figures hang on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Age {
    /// Made by these sources.
    Fresh,
    /// Made by others.
    Older,
    /// It does not say by which: made before pages said so, or of fewer cases than asked for.
    Unknown,
    /// The page is not there, or has no line of this study.
    Missing,
}

impl Age {
    /// Name of the age, as it is told.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Fresh => "fresh",
            Self::Older => "older than its code",
            Self::Unknown => "of sources unknown",
            Self::Missing => "missing",
        }
    }

    /// Age of what `study` makes of a page, where its sources have this hash.
    pub(super) fn of(page: &str, study: &str, hash: &str) -> Self {
        match line_of(page, study).map(|line| &page[line]) {
            Some(line) if line == made_by(study, hash) => Self::Fresh,
            Some(line) if line == made_by(study, FEWER) => Self::Unknown,
            Some(_) => Self::Older,
            None => Self::Missing,
        }
    }
}

/// Word in place of the hash, where fewer cases than the page tells of were measured.
pub(super) const FEWER: &str = "unknown";

/// The line that says which study made what stands here, from sources of which hash.
pub(super) fn made_by(study: &str, hash: &str) -> String {
    format!("{}{hash} -->", begin(study))
}

fn begin(study: &str) -> String {
    format!("<!-- made by cargo xtask study {study} from sources ")
}

fn end(study: &str) -> String {
    format!("<!-- end of what cargo xtask study {study} makes -->")
}

/// Bytes of a study's line in a page.
fn line_of(page: &str, study: &str) -> Option<Range<usize>> {
    let start = page.find(&begin(study))?;
    Some(start..start + page[start..].find('\n').unwrap_or(page.len() - start))
}

/// The part of this study in a page.
pub(super) fn part_of<'p>(page: &'p str, study: &str) -> Option<&'p str> {
    let after = line_of(page, study)?.end;
    let length = page[after..].find(&end(study))?;
    Some(page[after..after + length].trim())
}

/// The page with the part of this study replaced; `None` where it has no place for one.
pub(super) fn with_part(page: &str, study: &str, hash: &str, part: &str) -> Option<String> {
    let start = line_of(page, study)?.start;
    let last = start + page[start..].find(&end(study))?;
    let (before, after) = (&page[..start], &page[last..]);
    Some(format!("{before}{}\n\n{}\n\n{after}", made_by(study, hash), part.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "# A\n\nProse.\n\n<!-- made by cargo xtask study a from sources unknown -->\n\nold\n\n\
                        <!-- end of what cargo xtask study a makes -->\n\nMore.\n";

    #[test]
    fn a_part_is_replaced_between_its_lines_and_is_fresh_then() {
        let page = with_part(PAGE, "a", "12345678", "| new |\n").unwrap();
        let expected = PAGE.replace("unknown", "12345678").replace("old", "| new |");
        assert_eq!(page, expected);
        assert_eq!(part_of(&page, "a"), Some("| new |"));
        assert_eq!(Age::of(&page, "a", "12345678"), Age::Fresh);
    }

    #[test]
    fn a_page_of_other_sources_is_older_and_one_without_the_line_is_missing() {
        assert_eq!(Age::of(PAGE, "a", "12345678"), Age::Unknown);
        let older = PAGE.replace("unknown", "87654321");
        assert_eq!(Age::of(&older, "a", "12345678"), Age::Older);
        assert_eq!(Age::of(PAGE, "b", "12345678"), Age::Missing);
        assert_eq!(with_part(PAGE, "b", "12345678", ""), None);
    }
}
