//! Check that comments fit the line width; rustfmt checks code (`rustfmt.toml`). Tables, programs and
//! formulas in comments may be wider.

use crate::ci::findings::{COLUMNS, fail_on, read, sources};
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
    fail_on(broken)
}

/// Numbers of lines of prose that are too long.
fn long_lines(text: &str) -> Vec<usize> {
    let (mut long, mut is_fenced) = (Vec::new(), false);
    for (line, number) in text.lines().zip(1..) {
        let Some(comment) = line.trim_start().strip_prefix("//") else {
            is_fenced = false;
            continue;
        };
        let inside = comment.trim_start_matches(['/', '!']);
        is_fenced ^= inside.trim_start().starts_with("```");
        if line.chars().count() > COLUMNS && !is_fenced && !is_table_or_program(inside) {
            long.push(number);
        }
    }
    long
}

/// Whether a line is a row of a table, or an indented line of a program or of formulas.
fn is_table_or_program(inside: &str) -> bool {
    inside.trim_start().starts_with('|') || inside.starts_with("     ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_comments_are_told_and_what_has_columns_of_its_own_is_not() {
        let long = "word ".repeat(30);
        let text = format!(
            "// {long}\nlet x = \"{long}\";\n/// | {long} |\n//!     let y = {long};\n    /// {long}; so\n"
        );
        assert_eq!(long_lines(&text), [1, 5]);
        let fenced = format!("/// ```text\n/// {long}\n/// ```\n/// {long}\n");
        assert_eq!(long_lines(&fenced), [4]);
    }
}
