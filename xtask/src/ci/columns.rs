//! Lines of code and comments that fit: strings aside, which say what they say.

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

/// Numbers of lines that are too long; a string is continued over lines that rustfmt leaves alone.
fn long_lines(text: &str) -> impl Iterator<Item = usize> {
    let is_string = |line: &str| line.contains('"') || line.ends_with('\\') || !line.contains(' ');
    let lines = text.lines().zip(1..).filter(|(line, _)| line.chars().count() > COLUMNS);
    let long: Vec<usize> = lines
        .filter(|(line, _)| line.trim_start().starts_with("//") || !is_string(line.trim()))
        .filter(|(line, _)| !is_table_or_program(line.trim_start()))
        .map(|(_, number)| number)
        .collect();
    long.into_iter()
}

/// A row of a table, or a line of a program within a comment.
fn is_table_or_program(line: &str) -> bool {
    let inside = line.trim_start_matches(['/', '!']);
    inside.trim_start().starts_with('|')
        || inside.starts_with("     ")
        || inside.contains(';')
        || inside.contains('#')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_comments_and_code_are_told_and_strings_are_not() {
        let long = "word ".repeat(30);
        let text = format!("// {long}\nlet x = \"{long}\";\nlet y = {};\nshort\n", "x + ".repeat(40));
        assert_eq!(long_lines(&text).collect::<Vec<_>>(), [1, 3]);
    }
}
