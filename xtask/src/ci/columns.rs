//! Comments that fit their columns; rustfmt sees to code (`rustfmt.toml`). Tables, programs and formulas
//! within comments are as wide as they are.

use crate::house::folders::sources;
use crate::project::project_root;
use wayside::host::failure::Failure;

/// As `rustfmt.toml` has it.
const COLUMNS: usize = 110;

pub(super) fn check() -> Result<(), Failure> {
    let mut files = Vec::new();
    ["crates", "xtask"].iter().for_each(|place| sources(&project_root().join(place), &mut files));
    let mut broken = Vec::new();
    for file in files {
        let text = std::fs::read_to_string(&file).map_err(|e| Failure::system(&file, "read", e))?;
        broken.extend(
            long_lines(&text).map(|line| format!("{}:{line}: more than {COLUMNS} columns", file.display())),
        );
    }
    if broken.is_empty() { Ok(()) } else { Err(Failure::Refused(broken.join("\n"))) }
}

/// Numbers of lines of prose that are too long.
fn long_lines(text: &str) -> impl Iterator<Item = usize> {
    let is_long = |line: &&str| line.chars().count() > COLUMNS && line.trim_start().starts_with("//");
    let long: Vec<usize> = text
        .lines()
        .zip(1..)
        .filter(|(line, _)| is_long(line) && !is_table_or_program(line.trim_start()))
        .map(|(_, number)| number)
        .collect();
    long.into_iter()
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
        assert_eq!(long_lines(&text).collect::<Vec<_>>(), [1, 5]);
    }
}
