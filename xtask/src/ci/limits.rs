//! Check of the page of input limits: it lists each constant whose name marks it as a limit, with its value
//! and its file.

use crate::ci::findings::{fail_on, read};
use crate::house::{self, folders};
use crate::project::project_root;
use std::collections::BTreeMap;
use std::path::Path;
use wayside::host::failure::Failure;

const PAGE: &str = "docs/limits.md";

/// A constant by its file and name.
type ConstantId = (String, String);

pub(super) fn check() -> Result<(), Failure> {
    let root = project_root();
    fail_on(findings(&constants(&root)?, &rows(&read(&root.join(PAGE))?)))
}

/// All numeric constants, with values as the page shows them.
fn constants(root: &Path) -> Result<BTreeMap<ConstantId, String>, Failure> {
    let mut all = BTreeMap::new();
    for folder in house::crates(root)? {
        for file in folders::sources(&folder.join("src")) {
            let name = file.strip_prefix(root).unwrap_or(&file).display().to_string();
            let of_file = constants_of(&read(&file)?);
            all.extend(of_file.into_iter().map(|(constant, value)| ((name.clone(), constant), value)));
        }
    }
    Ok(all)
}

/// Names and values of the constants of a file, without those of tests.
fn constants_of(text: &str) -> BTreeMap<String, String> {
    let mut numbers: BTreeMap<String, f64> = BTreeMap::new();
    let mut all = BTreeMap::new();
    for line in text.split("#[cfg(test)]\nmod ").next().unwrap_or_default().lines() {
        let Some((name, value)) = constant(line) else { continue };
        if let Some(value) = number(value, &numbers) {
            numbers.insert(name.to_owned(), value);
            all.insert(name.to_owned(), shown(name, value));
        }
    }
    all
}

/// Name and expression of `const NAME: TYPE = EXPRESSION;`.
fn constant(line: &str) -> Option<(&str, &str)> {
    let (_, told) = line.split_once("const ")?;
    let (name, told) = told.split_once(": ")?;
    let (_, expression) = told.split_once(" = ")?;
    let (expression, _) = expression.split_once(';')?;
    let is_name = name.chars().all(|c| c.is_ascii_uppercase() || c == '_' || c.is_ascii_digit());
    is_name.then_some((name, expression))
}

/// Value of numbers and earlier constants, joined by `<<` or `*`.
fn number(expression: &str, known: &BTreeMap<String, f64>) -> Option<f64> {
    if let Some((left, right)) = expression.split_once(" << ") {
        return Some(number(left, known)? * number(right, known)?.exp2());
    }
    if let Some((left, right)) = expression.split_once(" * ") {
        return Some(number(left, known)? * number(right, known)?);
    }
    let word = expression.split_once(" as ").map_or(expression, |(word, _)| word).trim();
    known.get(word).copied().or_else(|| word.replace('_', "").parse().ok())
}

/// Bytes in binary units if the name contains "bytes", else a number.
fn shown(name: &str, value: f64) -> String {
    let is_bytes = name.split('_').any(|word| word == "BYTES");
    let units = [("GiB", 30), ("MiB", 20), ("KiB", 10)];
    let whole = |&(_, power): &(&str, i32)| value >= f64::from(power).exp2();
    match units.iter().find(|unit| is_bytes && whole(unit)) {
        Some((unit, power)) => format!("{} {unit}", value / f64::from(*power).exp2()),
        None if is_bytes => format!("{value} bytes"),
        None => grouped(value),
    }
}

/// Formats digits in groups of three.
fn grouped(value: f64) -> String {
    let digits = value.to_string();
    let (whole, rest) = digits.split_once('.').map_or((digits.as_str(), None), |(w, r)| (w, Some(r)));
    let mut text = String::new();
    for (place, digit) in whole.chars().enumerate() {
        if place > 0 && (whole.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    rest.map_or(text.clone(), |rest| format!("{text}.{rest}"))
}

/// Values of the page, by file and name: rows end with the value, the constant and its file.
fn rows(page: &str) -> Vec<(ConstantId, String)> {
    let row = |line: &str| {
        let cells: Vec<&str> = line.strip_prefix('|')?.strip_suffix('|')?.split('|').map(str::trim).collect();
        let [.., value, name, file] = cells[..] else { return None };
        let quoted = |cell: &str| Some(cell.strip_prefix('`')?.strip_suffix('`')?.to_owned());
        Some(((quoted(file)?, quoted(name)?), value.to_owned()))
    };
    page.lines().filter_map(row).collect()
}

/// A sentence for each limit that the page lacks or lists with another value.
fn findings(constants: &BTreeMap<ConstantId, String>, rows: &[(ConstantId, String)]) -> Vec<String> {
    let is_limit = |name: &str| name.split('_').any(|word| word == "LIMIT");
    let is_told = |place: &ConstantId| rows.iter().any(|(told, _)| told == place);
    let untold = constants.keys().filter(|place| is_limit(&place.1) && !is_told(place));
    let untold = untold.map(|(file, name)| format!("{PAGE}: no row tells of `{name}` of {file}"));
    let wrong = rows.iter().filter_map(|(place, told)| match constants.get(place) {
        Some(value) if value == told => None,
        Some(value) => Some(format!("{PAGE}: `{}` of {} is {value}, not {told}", place.1, place.0)),
        None => Some(format!("{PAGE}: there is no constant `{}` in {}", place.1, place.0)),
    });
    untold.chain(wrong).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = "/// Most.\npub(crate) const LINE_LIMIT: usize = 1 << 20;\n\
                          const LIMIT_BYTES: u64 = 4 << 30;\n\
                          const WHOLE_LIMIT: u64 = 3 * LINE_LIMIT as u64;\nconst WORD: &str = \"a\";\n\
                          const OF_THE_TEST_LIMIT: u32 = 1_000;\nconst UNLIMITED: u8 = 1;\n\
                          const SPEED_LIMIT: f64 = 0.5;\n\
                          #[cfg(test)]\nmod tests {\n    const INNER_LIMIT: u32 = 7;\n";

    #[test]
    fn values_are_those_of_the_code() {
        let found = constants_of(SOURCE);
        let of = |name: &str| found.get(name).map(String::as_str);
        assert_eq!(of("LINE_LIMIT"), Some("1,048,576"));
        assert_eq!(of("LIMIT_BYTES"), Some("4 GiB"));
        assert_eq!(of("WHOLE_LIMIT"), Some("3,145,728"));
        assert_eq!((of("OF_THE_TEST_LIMIT"), of("SPEED_LIMIT")), (Some("1,000"), Some("0.5")));
        assert_eq!((of("WORD"), of("INNER_LIMIT")), (None, None));
    }

    #[test]
    fn a_limit_that_is_not_told_and_one_that_is_told_wrong_are_found() {
        let place = |name: &str| ("a.rs".to_owned(), name.to_owned());
        let constants: BTreeMap<ConstantId, String> =
            constants_of(SOURCE).into_iter().map(|(name, value)| (place(&name), value)).collect();
        let page = "| what | most | constant | file |\n|---|---|---|---|\n\
                    | a line | 1,048,576 | `LINE_LIMIT` | `a.rs` |\n\
                    | a file | 4 MiB | `LIMIT_BYTES` | `a.rs` |\n\
                    | whole | 3,145,728 | `WHOLE_LIMIT` | `a.rs` |\n\
                    | none | 1 | `GONE_LIMIT` | `a.rs` |\n| test | 1,000 | `OF_THE_TEST_LIMIT` | `a.rs` |\n";
        assert_eq!(
            findings(&constants, &rows(page)),
            [
                "docs/limits.md: no row tells of `SPEED_LIMIT` of a.rs",
                "docs/limits.md: `LIMIT_BYTES` of a.rs is 4 GiB, not 4 MiB",
                "docs/limits.md: there is no constant `GONE_LIMIT` in a.rs",
            ]
        );
    }

    #[test]
    fn the_page_tells_every_limit_of_the_code() {
        check().unwrap();
    }
}
