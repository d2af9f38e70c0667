//! Text of measured tables: lines with their numbers, without comments, and their names in errors.

use std::path::Path;

/// Lines with content other than comments, numbered from 1.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (u32, &str)> {
    let bare = |line: &str| line.find('#').unwrap_or(line.len());
    let numbered = (1..).zip(text.lines().map(move |line| line[..bare(line)].trim()));
    numbered.filter(|(_, line)| !line.is_empty())
}

/// `FILE:LINE`, or the file alone if no line is at fault, 0.
pub(super) fn place(file: &Path, line: u32) -> String {
    match line {
        0 => file.display().to_string(),
        line => format!("{}:{line}", file.display()),
    }
}
