//! Parts of pages made by studies: a part between two lines with its name, the first with the hash of its
//! sources; or a whole page, with that line as its last one.

use std::ops::Range;

/// Freshness of a page relative to the sources of its figures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Freshness {
    /// Made by these sources.
    Fresh,
    /// Made by others.
    Older,
    /// Made by unknown sources: before pages contained the hash, or with fewer cases than requested.
    Unknown,
    /// The page is missing, or has no line of this study.
    Missing,
}

impl Freshness {
    /// Name of the freshness.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Fresh => "fresh",
            Self::Older => "older than its code",
            Self::Unknown => "of sources unknown",
            Self::Missing => "missing",
        }
    }

    /// Freshness of the part of `study` in a page, if its sources have this hash.
    pub(super) fn of(page: &str, study: &str, hash: &str) -> Self {
        match line_of(page, study).map(|line| &page[line]) {
            Some(line) if line == made_by(study, hash) => Self::Fresh,
            Some(line) if line == made_by(study, UNKNOWN_SOURCES) => Self::Unknown,
            Some(_) => Self::Older,
            None => Self::Missing,
        }
    }
}

/// Word instead of the hash if fewer cases than the page describes were measured.
pub(super) const UNKNOWN_SOURCES: &str = "unknown";

/// The line with the study that made the part, and the hash of its sources.
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

/// The first line of a part that differs from the new one; numbers may differ by one in their last digit.
pub(super) fn difference(told: &str, made: &str) -> Option<String> {
    let words = |line: &'_ str| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let are_alike = |(told, made): (&str, &str)| {
        let (told, made) = (words(told), words(made));
        told.len() == made.len() && told.iter().zip(&made).all(|(told, made)| is_alike(told, made))
    };
    let (told, made): (Vec<&str>, Vec<&str>) = (told.trim().lines().collect(), made.trim().lines().collect());
    let pairs = || told.iter().copied().zip(made.iter().copied());
    let shorter = || (told.len() != made.len()).then(|| format!("{} lines, made {}", told.len(), made.len()));
    pairs()
        .find(|pair| !are_alike(*pair))
        .map(|(told, made)| format!("`{told}`, made `{made}`"))
        .or_else(shorter)
}

/// Whether two words are equal, or numbers whose last digits differ by one.
fn is_alike(told: &str, made: &str) -> bool {
    let plain = |word: &str| word.trim_end_matches([',', ';', '.']).parse::<f64>().ok();
    let is_near = |(a, b): (f64, f64)| (a - b).abs() <= 1.01 * last_digit(told);
    told == made || plain(told).zip(plain(made)).is_some_and(is_near)
}

/// Value of one unit in the last digit of a number as written.
fn last_digit(number: &str) -> f64 {
    let (digits, power) = number.split_once('e').unwrap_or((number, "0"));
    let decimals =
        digits.trim_end_matches([',', ';', '.']).split_once('.').map_or(0, |(_, d)| d.len() as i32);
    10.0_f64.powi(power.parse().unwrap_or(0) - decimals)
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
        assert_eq!(Freshness::of(&page, "a", "12345678"), Freshness::Fresh);
    }

    #[test]
    fn a_figure_that_is_another_one_is_told_and_a_last_digit_is_none() {
        let told = "| a | 5.221 | 4.6e-5 |\n\n155 cells, -4.8 dBsm.\n";
        assert_eq!(difference(told, told), None);
        assert_eq!(difference(told, "| a | 5.222 | 4.5e-5 |\n\n155 cells, -4.8 dBsm.\n"), None);
        let other = difference(told, "| a | 5.223 | 4.6e-5 |\n\n155 cells, -4.8 dBsm.\n");
        assert_eq!(other.unwrap(), "`| a | 5.221 | 4.6e-5 |`, made `| a | 5.223 | 4.6e-5 |`");
        assert!(difference(told, "| a | 5.221 | 4.8e-5 |\n\n155 cells, -4.8 dBsm.\n").is_some());
        assert!(difference(told, "| b | 5.221 | 4.6e-5 |\n\n155 cells, -4.8 dBsm.\n").is_some());
        assert_eq!(difference(told, "| a | 5.221 | 4.6e-5 |").unwrap(), "3 lines, made 1");
    }

    #[test]
    fn a_page_of_other_sources_is_older_and_one_without_the_line_is_missing() {
        assert_eq!(Freshness::of(PAGE, "a", "12345678"), Freshness::Unknown);
        let older = PAGE.replace("unknown", "87654321");
        assert_eq!(Freshness::of(&older, "a", "12345678"), Freshness::Older);
        assert_eq!(Freshness::of(PAGE, "b", "12345678"), Freshness::Missing);
        assert_eq!(with_part(PAGE, "b", "12345678", ""), None);
    }
}
