//! Check of sizes: files under 600 lines, no function over 70 (clippy's `too_many_lines` checks single
//! functions too), nine functions in ten under 25 lines, the median under 10.

use crate::ci::findings::{fail_on, read, sources};
use std::path::Path;
use wayside::host::failure::Failure;

const FILE_LINES: usize = 600;
const FUNCTION_LINES: usize = 70;
const NINE_IN_TEN_LINES: usize = 25;
const MEDIAN_LINES: usize = 10;

pub(super) fn check() -> Result<(), Failure> {
    let (mut broken, mut lengths) = (Vec::new(), Vec::new());
    for file in sources() {
        let text = read(&file)?;
        judge(&file, &text, &mut broken, &mut lengths);
    }
    broken.extend(spread(&mut lengths));
    fail_on(broken)
}

fn judge(file: &Path, text: &str, broken: &mut Vec<String>, lengths: &mut Vec<usize>) {
    let lines = text.lines().count();
    if lines >= FILE_LINES {
        broken.push(format!("{}: {lines} lines, the limit is {FILE_LINES}", file.display()));
    }
    for (line, length) in functions(text) {
        if length > FUNCTION_LINES {
            broken.push(format!(
                "{}:{line}: a function of {length} lines, the limit is {FUNCTION_LINES}",
                file.display()
            ));
        }
        lengths.push(length);
    }
}

fn spread(lengths: &mut [usize]) -> Vec<String> {
    lengths.sort_unstable();
    let at = |share: f64| lengths.get((share * lengths.len() as f64) as usize).copied().unwrap_or(0);
    let mut broken = Vec::new();
    if at(0.5) >= MEDIAN_LINES {
        broken.push(format!("the median function has {} lines, the limit is under {MEDIAN_LINES}", at(0.5)));
    }
    if at(0.9) >= NINE_IN_TEN_LINES {
        broken.push(format!(
            "one function in ten has {} lines or more, the limit is under {NINE_IN_TEN_LINES}",
            at(0.9)
        ));
    }
    broken
}

/// First line and body length of each function, by rustfmt's indentation: the body ends at the first line
/// that closes a brace at the depth of the `fn`.
fn functions(text: &str) -> Vec<(usize, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (i, line) in lines.iter().enumerate() {
        let trimmed = line.trim_start();
        let depth = line.len() - trimmed.len();
        if is_function(trimmed) {
            found.push((i + 1, body_length(&lines[i..], depth)));
        }
    }
    found
}

fn is_function(line: &str) -> bool {
    let words = line.split_whitespace().take_while(|w| !w.contains('('));
    let starts = ["pub", "fn", "const", "async", "unsafe"].iter().any(|w| line.starts_with(w))
        || line.starts_with("pub(");
    starts && (words.clone().any(|w| w == "fn") || line.contains(") fn ")) && !line.ends_with(';')
}

fn body_length(lines: &[&str], depth: usize) -> usize {
    let opens = lines.iter().position(|l| l.ends_with('{')).unwrap_or(0);
    if lines[0].ends_with('}') {
        return 1;
    }
    let closes = |l: &&str| l.len() == depth + 1 && l.trim_start() == "}";
    let end = lines.iter().position(closes).unwrap_or(opens);
    end.saturating_sub(opens + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_are_found_with_the_length_of_their_bodies() {
        let text = "pub(crate) fn a(\n    x: u8,\n) -> u8 {\n    x\n}\n\nimpl B {\n    fn b() {}\n    fn c() {\n        1;\n        2\n    }\n}\n";
        assert_eq!(functions(text), [(1, 1), (8, 1), (9, 2)]);
    }

    #[test]
    fn a_function_beyond_the_limit_is_named_with_its_line() {
        let text = format!("fn long() {{\n{}}}\n", "    1;\n".repeat(71));
        let (mut broken, mut lengths) = (vec![], vec![]);
        judge(Path::new("a.rs"), &text, &mut broken, &mut lengths);
        assert_eq!(broken, ["a.rs:1: a function of 71 lines, the limit is 70"]);
    }
}
