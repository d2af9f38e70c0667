//! Text of tables that are measured: lines with their numbers, comments left out, and how errors name them.

use std::path::Path;

/// Lines that hold something besides a comment, numbered from 1.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (u32, &str)> {
    let bare = |line: &str| line.find('#').unwrap_or(line.len());
    let numbered = (1..).zip(text.lines().map(move |line| line[..bare(line)].trim()));
    numbered.filter(|(_, line)| !line.is_empty())
}

/// `FILE:LINE`, or the file alone where no line is at fault, 0.
pub(super) fn place(file: &Path, line: u32) -> String {
    match line {
        0 => file.display().to_string(),
        line => format!("{}:{line}", file.display()),
    }
}
