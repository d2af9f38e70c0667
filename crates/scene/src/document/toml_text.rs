//! Nesting depth of TOML. The parser limits the tables that one key opens and the nesting of lists and
//! tables, but not their product: a text of some kilobytes can have six thousand levels, and recursion over
//! these overflows the stack. Nor does its limit hold where it recovers from errors. All readers of TOML
//! check here first.

use std::fmt;
use toml::Spanned;
use toml::de::{DeTable, DeValue};
use toml_parser::Source;
use toml_parser::lexer::TokenKind;

/// Largest number of tables and lists around a value: scenes, studies, recipes and manifests have six.
pub(crate) const DEPTH_LIMIT: usize = 64;

/// Fault of a value in more tables and lists than are read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TooDeep {
    /// Byte at which the value begins.
    pub byte: usize,
}

impl fmt::Display for TooDeep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a value lies within more than {DEPTH_LIMIT} tables and lists, the most that are read")
    }
}

impl std::error::Error for TooDeep {}

/// Refuses a text with a value nested too deeply; text that is not TOML passes, and its reader refuses it.
///
/// # Errors
/// The first such value found.
pub fn check_text(text: &str) -> Result<(), TooDeep> {
    check_brackets(text)?;
    check(DeTable::parse_recoverable(text).0.get_ref())
}

/// Refuses a text with too many brackets open at once, before it is parsed: the parser walks open brackets by
/// recursion, without a limit after an error. A bracket that does not close the last open one closes none, as
/// for the parser.
///
/// # Errors
/// The first bracket beyond the limit.
pub fn check_brackets(text: &str) -> Result<(), TooDeep> {
    let mut open = vec![];
    for token in Source::new(text).lex() {
        match token.kind() {
            kind @ (TokenKind::LeftSquareBracket | TokenKind::LeftCurlyBracket) => open.push(kind),
            TokenKind::RightSquareBracket => close(&mut open, TokenKind::LeftSquareBracket),
            TokenKind::RightCurlyBracket => close(&mut open, TokenKind::LeftCurlyBracket),
            _ => {}
        }
        if open.len() > DEPTH_LIMIT {
            return Err(TooDeep { byte: token.span().start() });
        }
    }
    Ok(())
}

fn close(open: &mut Vec<TokenKind>, opening: TokenKind) {
    open.pop_if(|last| *last == opening);
}

/// Refuses a document with a value nested too deeply.
///
/// # Errors
/// The first such value found.
pub fn check(document: &DeTable<'_>) -> Result<(), TooDeep> {
    check_all(document.values().map(|value| (value, 1)).collect())
}

/// Refuses a value with a part nested too deeply.
pub(crate) fn check_value(value: &Spanned<DeValue<'_>>) -> Result<(), TooDeep> {
    check_all(vec![(value, 0)])
}

/// An explicit stack: deeply nested values must not be walked by recursion.
fn check_all(mut waiting: Vec<(&Spanned<DeValue<'_>>, usize)>) -> Result<(), TooDeep> {
    while let Some((value, around)) = waiting.pop() {
        if around > DEPTH_LIMIT {
            return Err(TooDeep { byte: value.span().start });
        }
        match value.get_ref() {
            DeValue::Array(list) => waiting.extend(list.iter().map(|part| (part, around + 1))),
            DeValue::Table(table) => waiting.extend(table.values().map(|part| (part, around + 1))),
            _ => {}
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tables in a line, as many keys in each; a byte less than ten for a level.
    fn within(tables: usize, keys: usize) -> String {
        let key = vec!["a"; keys].join(".");
        (0..tables).fold("1".to_owned(), |inner, _| format!("{{ {key} = {inner} }}"))
    }

    #[test]
    fn a_value_within_as_many_tables_and_lists_as_are_read_passes_and_one_deeper_is_told() {
        let lists = |count: usize| format!("{}1{}", "[".repeat(count), "]".repeat(count));
        // The document is a table itself.
        for most in [within(63, 1), within(9, 7), lists(63)] {
            assert_eq!(check_text(&format!("a = {most}")), Ok(()), "{most}");
        }
        for deeper in [within(64, 1), within(8, 8), lists(64)] {
            let text = format!("b = 1\na = {deeper}");
            let byte = text.rfind('1').unwrap();
            assert_eq!(check_text(&text), Err(TooDeep { byte }), "{text}");
        }
        let headers = format!("[{}]\nb = 1", vec!["a"; 64].join("."));
        assert!(check_text(&headers).is_err());
    }

    #[test]
    fn six_thousand_levels_in_some_kilobytes_are_refused_without_recursion() {
        let text = format!("a = {}", within(79, 79));
        assert!(text.len() < 1 << 14);
        assert!(DeTable::parse(&text).is_ok(), "the parser's own bounds do not hold their product");
        assert!(check_text(&text).is_err());
    }

    #[test]
    fn brackets_that_mismatched_ones_leave_open_are_refused_before_they_are_parsed() {
        let mismatched = r#"b = { layers = [{ substance = "p", { t = 3 }, "#.repeat(20_000);
        let too_deep = check_text(&mismatched).unwrap_err();
        assert!(mismatched[too_deep.byte..].starts_with(['[', '{']), "{too_deep:?}");
        let quoted = format!("a = '{0}' # {0}", "[{".repeat(100));
        assert_eq!(check_text(&quoted), Ok(()));
    }
}
