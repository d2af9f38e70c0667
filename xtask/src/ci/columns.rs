//! Comments that fit their columns; rustfmt sees to code (`rustfmt.toml`). Tables, programs and formulas
//! within comments are as wide as they are.

use crate::ci::findings::{COLUMNS, none_of, read, sources};
use wayside::host::failure::Failure;

pub(super) fn check() -> Result<(), Failure> {
    let mut broken = Vec::new();
    for file in sources() {
        let text = read(&file)?;
        broken.extend(
            long_lines(&text)
                .into_iter()
                .map(|line| format!("{}:{line}: more than {COLUMNS} columns", file.display())),
        );
    }
    none_of(broken)
}

/// Numbers of lines of prose that are too long.
fn long_lines(text: &str) -> Vec<usize> {
    let is_long = |line: &&str| line.chars().count() > COLUMNS && line.trim_start().starts_with("//");
    let prose =
        text.lines().zip(1..).filter(|(line, _)| is_long(line) && !is_table_or_program(line.trim_start()));
    prose.map(|(_, number)| number).collect()
}

/// A row of a table, a line of a program, or formulas in columns.
fn is_table_or_program(line: &str) -> bool {
    let inside = line.trim_start_matches(['/', '!']);
    inside.trim_start().starts_with('|') || inside.contains([';', '#', '{']) || inside.contains("    ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_comments_are_told_and_what_has_columns_of_its_own_is_not() {
        let long = "word ".repeat(30);
        let text =
            format!("// {long}\nlet x = \"{long}\";\n/// | {long} |\n//! let y = {long};\n    /// {long}\n");
        assert_eq!(long_lines(&text), [1, 5]);
    }
}
