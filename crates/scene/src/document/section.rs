//! A scene file as tables with positions; broken rules are noted and reading continues.

use crate::document::diagnostics::{Diagnostics, UnknownKeys};
use crate::document::errors::{Place, Rule};
use crate::document::keys;
use crate::document::keys::key::Table;
use crate::document::synonyms;
use crate::wording::allowed_range::AllowedRange;
use crate::wording::similarity::{nearest, nearest_from};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// One table of the file; an absent one reads as empty, so that every key has its default.
#[derive(Clone)]
pub struct Section<'d> {
    table: Option<&'d DeTable<'d>>,
    known: &'static Table,
    place: Place,
    start: usize,
    diagnostics: &'d Diagnostics<'d>,
}

/// A value of the file, and where it stands.
pub type SpannedValue<'d> = Spanned<DeValue<'d>>;

impl<'d> Section<'d> {
    /// The file itself. Unknown keys are noted at once, here and in every section opened from it.
    pub fn root(table: &'d DeTable<'d>, known: &'static Table, diagnostics: &'d Diagnostics<'d>) -> Self {
        Self { table: Some(table), known, place: Place::Scene, start: 0, diagnostics }.checked()
    }

    /// The table of that name below this one.
    pub fn section(&self, known: &'static Table) -> Section<'d> {
        let found = self.find(key_of(known));
        let table = found.and_then(|value| match value.get_ref() {
            DeValue::Table(table) => Some(table),
            _ => {
                self.wrong_type(key_of(known), "a table", value);
                None
            }
        });
        let start = found.map_or(self.start, |value| value.span().start);
        Section { table, known, place: Place::Table(known.name), start, diagnostics: self.diagnostics }
            .checked()
    }

    /// Opens the tables of an array of tables, each named by its `id` or its number.
    pub fn sections(&self, known: &'static Table) -> Vec<Section<'d>> {
        let Some(value) = self.find(key_of(known)) else { return vec![] };
        let DeValue::Array(array) = value.get_ref() else {
            let expected = "an array of tables, each under a heading in double brackets";
            self.wrong_type(key_of(known), expected, value);
            return vec![];
        };
        let numbered = array.iter().enumerate();
        numbered.filter_map(|(i, element)| self.element(known, i, element)).collect()
    }

    /// Opens a table below this one.
    pub(crate) fn subtable(
        &self,
        known: &'static Table,
        place: Place,
        value: &'d SpannedValue<'d>,
    ) -> Section<'d> {
        let table = value.get_ref().as_table();
        Section { table, known, place, start: value.span().start, diagnostics: self.diagnostics }.checked()
    }

    /// Place named in errors about this table.
    pub(crate) fn place(&self) -> &Place {
        &self.place
    }

    fn element(
        &self,
        known: &'static Table,
        index: usize,
        element: &'d SpannedValue<'d>,
    ) -> Option<Section<'d>> {
        let DeValue::Table(table) = element.get_ref() else {
            self.wrong_type(key_of(known), "an array of tables", element);
            return None;
        };
        let name = match table.get("id").map(|id| id.get_ref()) {
            Some(DeValue::String(id)) => id.to_string(),
            _ => format!("#{}", index + 1),
        };
        let place = match known.name {
            "target" => Place::Target(name),
            "clutter" => Place::Clutter(name),
            "radars" => Place::Radar(name),
            other => Place::Table(other),
        };
        Some(self.subtable(known, place, element))
    }

    fn checked(self) -> Self {
        for (key, value) in self.table.into_iter().flat_map(|table| table.iter()) {
            let found = key.get_ref().as_ref();
            if !self.known.has(found)
                && let Some(rule) = self.unexpected_key(found, value.get_ref())
            {
                self.note_at(key.span(), rule);
            }
        }
        self
    }

    /// Rule that a key breaks which the table does not have.
    fn unexpected_key(&self, found: &str, value: &DeValue<'_>) -> Option<Rule> {
        match self.diagnostics.unknown_keys() {
            UnknownKeys::Refused => Some(unknown_key((found, value), self.known, self.diagnostics.tables())),
            UnknownKeys::Allowed => {
                let absent: Vec<&'static str> =
                    self.known.names().filter(|key| self.find(key).is_none()).collect();
                let meant = synonyms::synonym_in_table(found, self.known).filter(|key| absent.contains(key));
                let nearest = meant.or_else(|| nearest_from(LEAST_SIMILARITY, found, &absent))?;
                Some(Rule::UnknownKey { found: found.to_owned(), nearest: Some(nearest), home: None })
            }
        }
    }

    /// Whether the key is there at all.
    pub fn has(&self, key: &'static str) -> bool {
        self.find(key).is_some()
    }

    /// Whether the table itself is there.
    pub fn exists(&self) -> bool {
        self.table.is_some()
    }

    /// Line of the table's heading.
    pub(crate) fn line(&self) -> u32 {
        self.diagnostics.line(self.start)
    }

    /// Note a broken rule at the value of `key`, or at the table's heading where the key is absent.
    pub fn note(&self, key: &'static str, rule: Rule) {
        let byte = self.find(key).map_or(self.start, |value| value.span().start);
        self.diagnostics.note(byte, self.place.clone(), rule);
    }

    /// Note a broken rule at an element of the list that `key` holds, by its number from 0; at a value that
    /// is no list as [`Section::note`] does.
    pub fn note_element(&self, key: &'static str, number: usize, rule: Rule) {
        let list = self.find(key).and_then(|value| value.get_ref().as_array());
        match list.and_then(|list| list.get(number)) {
            Some(element) => self.note_at(element.span(), rule),
            None => self.note(key, rule),
        }
    }

    /// Note it if `key` is missing.
    pub fn require(&self, key: &'static str) {
        if !self.has(key) {
            self.note(key, Rule::Missing { key });
        }
    }

    /// The elements of a list of allowed length; `None` for other values.
    pub(crate) fn list(
        &self,
        key: &'static str,
        value: &'d SpannedValue<'d>,
        length: AllowedRange,
    ) -> Option<&'d [SpannedValue<'d>]> {
        let DeValue::Array(array) = value.get_ref() else {
            self.wrong_type(key, "a list", value);
            return None;
        };
        if !length.holds(array.len() as f64) {
            self.note_at(value.span(), Rule::WrongLength { key, expected: length, found: array.len() });
            return None;
        }
        Some(array)
    }

    /// Notes that a value has another type than `expected`.
    pub(crate) fn wrong_type(&self, key: &'static str, expected: &'static str, value: &SpannedValue<'_>) {
        let found = type_of(value.get_ref());
        self.note_at(value.span(), Rule::WrongType { key, expected, found });
    }

    /// Notes a broken rule at a position.
    pub(crate) fn note_at(&self, span: Range<usize>, rule: Rule) {
        self.diagnostics.note(span.start, self.place.clone(), rule);
    }

    /// The value of a key.
    pub(crate) fn find(&self, key: &str) -> Option<&'d SpannedValue<'d>> {
        self.table.and_then(|table| table.get(key))
    }
}

fn key_of(table: &'static Table) -> &'static str {
    table.name.rsplit('.').next().unwrap_or(table.name)
}

/// Four letters in five alike are no coincidence; fewer may be, and a different word has none.
const LEAST_SIMILARITY: f64 = 0.85;

fn unknown_key((found, value): (&str, &DeValue<'_>), table: &Table, tables: &'static [Table]) -> Rule {
    let found_here = found.to_owned();
    let here = |nearest| Rule::UnknownKey { found: found_here.clone(), nearest, home: None };
    if let Some(meant) = synonyms::synonym_in_table(found, table) {
        return here(Some(meant));
    }
    let homes = |key| keys::tables_with_key(tables, (key, value), table);
    let of_key = homes(found);
    if !of_key.is_empty() {
        return Rule::WrongTable { found: found_here, tables: of_key };
    }
    let known: Vec<&str> = table.names().collect();
    let elsewhere = |key| Some((key, *homes(key).first()?));
    match (nearest_from(LEAST_SIMILARITY, found, &known), synonyms::synonyms(found).find_map(elsewhere)) {
        (None, Some((meant, home))) => {
            Rule::UnknownKey { found: found_here, nearest: Some(meant), home: Some(home) }
        }
        _ => here(nearest(found, &known)),
    }
}

fn type_of(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a text",
        DeValue::Integer(_) => "a whole number",
        DeValue::Float(_) => "a number with a point",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date or time",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}
