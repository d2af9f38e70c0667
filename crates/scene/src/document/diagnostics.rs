//! Broken rules of one file, noted in any order and reported in that of the file: at most the first hundred.

use crate::document::errors::{Place, Position, Rule, SceneError, SceneErrors};
use crate::document::keys::{self, Table};
use crate::document::toml_text;
use std::cell::{OnceCell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use toml::de::DeTable;

/// Largest number of reported errors, as many as a person reads; a file with more is another file given by
/// mistake.
const MOST_REPORTED: usize = 100;

/// Byte of a value without a position in the file: one that a change puts into a table which the file omits.
pub(crate) const NOWHERE: usize = usize::MAX;

/// Treatment of keys that a table does not have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum UnknownKeys {
    /// They are errors.
    Refused,
    /// They are left to other readers, unless one is another spelling of a key that is not there.
    Allowed,
}

/// Broken rules of one file. Noting one takes the same however many there are.
pub struct Diagnostics<'s> {
    file: &'s Path,
    text: &'s str,
    /// All tables that such a file may hold.
    tables: &'static [Table],
    unknown_keys: UnknownKeys,
    /// Bytes at which lines begin, found when first needed.
    lines: OnceCell<Vec<usize>>,
    syntax: RefCell<FirstErrors>,
    others: RefCell<FirstErrors>,
}

/// The first errors of the file, by their bytes and then in the order of noting.
#[derive(Default)]
struct FirstErrors {
    kept: BTreeMap<(usize, u64), (Place, Rule)>,
    noted: u64,
}

impl FirstErrors {
    fn note(&mut self, byte: usize, place: Place, rule: Rule) {
        self.kept.insert((byte, self.noted), (place, rule));
        self.noted += 1;
        if self.kept.len() > MOST_REPORTED {
            self.kept.pop_last();
        }
    }

    /// Number of noted errors that were not kept.
    fn more(&self) -> u64 {
        self.noted - self.kept.len() as u64
    }
}

impl<'s> Diagnostics<'s> {
    /// Nothing is wrong yet with the text of a scene.
    pub(crate) fn new(file: &'s Path, text: &'s str) -> Self {
        Self::of_tables(file, text, keys::TABLES)
    }

    /// Nothing is wrong yet with a text that may hold these tables.
    pub fn of_tables(file: &'s Path, text: &'s str, tables: &'static [Table]) -> Self {
        let (syntax, others) = (RefCell::default(), RefCell::default());
        let unknown_keys = UnknownKeys::Refused;
        Self { file, text, tables, unknown_keys, lines: OnceCell::new(), syntax, others }
    }

    /// Nothing is wrong yet with a text that may hold these tables, and keys of others in them and beside
    /// them.
    pub fn allowing_unknown_keys(file: &'s Path, text: &'s str, tables: &'static [Table]) -> Self {
        Self { unknown_keys: UnknownKeys::Allowed, ..Self::of_tables(file, text, tables) }
    }

    pub(crate) fn tables(&self) -> &'static [Table] {
        self.tables
    }

    pub(crate) fn unknown_keys(&self) -> UnknownKeys {
        self.unknown_keys
    }

    /// The document that the text says, as far as it is TOML; none where it is too deep to be walked. Noted
    /// is what is wrong with it.
    pub fn document(&self) -> DeTable<'s> {
        let brackets = toml_text::check_brackets(self.text);
        let parsed = brackets.as_ref().map_or_else(|too_deep| &self.text[..too_deep.byte], |()| self.text);
        let (document, syntax) = DeTable::parse_recoverable(parsed);
        for error in &syntax {
            let byte = error.span().map_or(self.text.len(), |span| span.start);
            self.note(byte, Place::Scene, Rule::Syntax { message: error.message().to_owned() });
        }
        match brackets.and_then(|()| toml_text::check(document.get_ref())) {
            Ok(()) => document.into_inner(),
            Err(too_deep) => {
                self.note(too_deep.byte, Place::Scene, Rule::Depth(too_deep));
                DeTable::new()
            }
        }
    }

    pub(crate) fn note(&self, byte: usize, place: Place, rule: Rule) {
        let is_of_text = matches!(rule, Rule::Syntax { .. } | Rule::Depth(_));
        let first = if is_of_text { &self.syntax } else { &self.others };
        first.borrow_mut().note(byte, place, rule);
    }

    /// The line of a byte, from 1.
    pub(crate) fn line(&self, byte: usize) -> u32 {
        let newlines =
            |text: &str| text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i + 1).collect();
        let begins = self.lines.get_or_init(|| newlines(self.text));
        begins.partition_point(|begin| *begin <= byte) as u32 + 1
    }

    fn position(&self, byte: usize) -> Option<Position> {
        if byte == NOWHERE {
            return None;
        }
        let before = self.text.get(..byte).unwrap_or(self.text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let column = before[line_start..].chars().count() as u32 + 1;
        Some(Position { line: self.line(before.len()), column })
    }

    /// Returns the noted errors in the order of the file. Where the text is not TOML, what else is said of
    /// the same line, or said to be missing, only follows from the first that is.
    ///
    /// # Errors
    /// The noted ones, where there are any.
    pub fn into_errors(self) -> Result<(), SceneErrors> {
        let (syntax, others) = (self.syntax.take(), self.others.take());
        let mut more = syntax.more() + others.more();
        let damaged: BTreeSet<u32> = syntax.kept.keys().map(|(byte, _)| self.line(*byte)).collect();
        let follows = |byte: usize, rule: &Rule| match rule {
            Rule::Missing { .. } => !damaged.is_empty(),
            _ => damaged.contains(&self.line(byte)),
        };
        let mut told: BTreeMap<_, _> = others.kept;
        told.retain(|(byte, _), (_, rule)| !follows(*byte, rule));
        let mut lines = BTreeSet::new();
        told.extend(syntax.kept.into_iter().filter(|((byte, _), _)| lines.insert(self.line(*byte))));
        while told.len() > MOST_REPORTED {
            told.pop_last();
            more += 1;
        }
        let error = |((byte, _), (place, rule)): ((usize, u64), (Place, Rule))| SceneError {
            file: PathBuf::from(self.file),
            position: self.position(byte),
            place,
            rule,
        };
        if told.is_empty() { Ok(()) } else { Err(SceneErrors(told.into_iter().map(error).collect(), more)) }
    }
}
