//! A source file prepared for the search of names: without comments, strings and the content of test modules.

use std::path::{Path, PathBuf};
use wayside::host::failure::Failure;

/// A module of a crate, which is a file.
pub(crate) struct SourceFile {
    pub(crate) place: PathBuf,
    /// Names from the crate's root; empty for the root itself.
    pub(crate) module: Vec<String>,
    /// Remaining text without comments, strings and scopes.
    pub(crate) text: String,
    lines: usize,
    product: usize,
    /// Names of its modules of tests that are files.
    tests: Vec<String>,
}

impl SourceFile {
    /// Reads `place`, which is below the crate's `source`.
    pub(crate) fn read(source: &Path, place: &Path) -> Result<Self, Failure> {
        let text = std::fs::read_to_string(place).map_err(|e| Failure::system(place, "read", e))?;
        let mut module: Vec<String> = place
            .strip_prefix(source)
            .unwrap_or(place)
            .with_extension("")
            .iter()
            .map(|name| name.to_string_lossy().into_owned())
            .collect();
        if matches!(module.as_slice(), [root] if root == "lib" || root == "main") {
            module.clear();
        }
        let plain = without_comments_and_strings(&text);
        Ok(Self {
            place: place.to_owned(),
            module,
            text: super_as_self(&without_visibility_paths(&plain)),
            lines: code_lines(&text),
            product: code_lines(split_at_tests(&text).0),
            tests: files_of_tests(&plain),
        })
    }

    /// Lines that are neither blank nor comments.
    pub(crate) fn code_lines(&self) -> usize {
        self.lines
    }

    /// Lines of code before the file's module of tests.
    pub(crate) fn product_lines(&self) -> usize {
        self.product
    }

    /// Its modules of tests that are files, from the crate's root.
    pub(crate) fn modules_of_tests(&self) -> Vec<Vec<String>> {
        self.tests.iter().map(|name| [self.module.as_slice(), std::slice::from_ref(name)].concat()).collect()
    }
}

fn code_lines(text: &str) -> usize {
    text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//")).count()
}

/// Attribute of modules of tests.
const TEST_ATTRIBUTE: &str = "#[cfg(test)]\n";

/// The text before the file's module of tests, and that module.
fn split_at_tests(text: &str) -> (&str, &str) {
    let mut places = text.match_indices(TEST_ATTRIBUTE).map(|(at, _)| at);
    let is_module = |line: &str| line.starts_with("mod ") && is_open(line);
    let with_body = places.find(|at| text[*at..].lines().nth(1).is_some_and(is_module));
    text.split_at(with_body.unwrap_or(text.len()))
}

/// Names of modules of tests that are declared in a text without comments and strings, and are files.
fn files_of_tests(text: &str) -> Vec<String> {
    let declared = text.split(TEST_ATTRIBUTE).skip(1).filter_map(|behind| behind.lines().next());
    let names = declared.filter_map(|line| line.split_once("mod ")?.1.split_once(';'));
    names.map(|(name, _)| name.to_owned()).collect()
}

/// Removes the paths of `pub(in path)`, which are not uses.
fn without_visibility_paths(text: &str) -> String {
    let mut parts = text.split("pub(in ");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |kept, part| kept + "pub" + part.split_once(')').map_or(part, |(_, rest)| rest))
}

/// Replaces `super` in the file's module of tests, where it means the file itself, by `self`.
fn super_as_self(text: &str) -> String {
    let (own, tests) = split_at_tests(text);
    let tests =
        tests.replace("super::super::", "\u{1}").replace("super::", "self::").replace('\u{1}', "super::");
    format!("{own}{tests}")
}

fn is_open(line: &str) -> bool {
    line.trim_end().ends_with('{')
}

/// Removes comments and string contents, keeping the line numbers.
fn without_comments_and_strings(text: &str) -> String {
    let mut kept = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(['/', '"', '\'']) {
        kept.push_str(&rest[..at]);
        rest = &rest[at..];
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if let Some(string) = rest.strip_prefix('"') {
            2 + closing_quote(string)
        } else {
            char_literal_length(rest)
        };
        if length == 1 {
            kept.push_str(&rest[..1]);
        }
        rest = &rest[length.min(rest.len())..];
    }
    kept + rest
}

/// Byte of the quotation mark that ends a string.
fn closing_quote(string: &str) -> usize {
    let mut is_escaped = false;
    for (at, sign) in string.char_indices() {
        match sign {
            '\\' if !is_escaped => is_escaped = true,
            '"' if !is_escaped => return at,
            _ => is_escaped = false,
        }
    }
    string.len()
}

/// Length of a character literal; 1 for a lifetime or an apostrophe.
fn char_literal_length(text: &str) -> usize {
    let Some(inside) = text.strip_prefix('\'') else { return 1 };
    if let Some(escaped) = inside.strip_prefix('\\') {
        return escaped.find('\'').map_or(1, |at| at + 3);
    }
    let length = inside.chars().next().map_or(0, char::len_utf8);
    if inside[length..].starts_with('\'') { length + 2 } else { 1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_comments_and_strings_are_no_names() {
        let text = "use a::b; // crate::c\nlet x = \"crate::\\\"d\"; let y = '\"'; fn f<'l>(z: &'l str) { 'n' / e::f }\n";
        assert_eq!(
            without_comments_and_strings(text),
            "use a::b; \nlet x = ; let y = ; fn f<'l>(z: &'l str) {  / e::f }\n"
        );
    }

    #[test]
    fn lines_of_tests_are_no_lines_of_the_product() {
        let text = "mod a;\n#[cfg(test)]\npub(crate) mod test_body; // shared\n\
                    #[cfg(test)]\nmod tests {\n    use super::*;\n}\n";
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("rooms.rs");
        std::fs::write(&place, text).unwrap();
        let file = SourceFile::read(folder.path(), &place).unwrap();
        assert_eq!((file.code_lines(), file.product_lines()), (7, 3));
        assert_eq!(file.modules_of_tests(), [["rooms", "test_body"]]);
        std::fs::write(&place, "fn a() {}\n").unwrap();
        let file = SourceFile::read(folder.path(), &place).unwrap();
        assert_eq!((file.code_lines(), file.product_lines()), (1, 1));
    }

    #[test]
    fn super_in_a_module_of_tests_is_the_file() {
        let text = "use super::a;\n#[cfg(test)]\nmod tests {\n use super::*;\n use super::super::b;\n}\n";
        assert!(super_as_self(text).contains("use self::*;\n use super::b;"));
        assert!(super_as_self(text).starts_with("use super::a;"));
        let behind_another = format!("#[cfg(test)]\nmod requests;\n{text}");
        assert!(super_as_self(&behind_another).contains("use self::*;\n use super::b;"));
    }
}
