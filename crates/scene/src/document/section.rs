//! A scene file as tables that know their place: reads typed values, notes every broken rule and goes on.

use crate::document::errors::{Place, Rule};
use crate::document::faults::Faults;
use crate::document::keys::{self, Table};
use crate::document::synonyms;
use crate::wording::allowed::Allowed;
use crate::wording::likeness::{nearest, nearest_from};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

/// One table of the file; an absent one reads as empty, so that every key takes its default.
#[derive(Clone)]
pub(crate) struct Section<'d> {
    table: Option<&'d DeTable<'d>>,
    known: &'static Table,
    place: Place,
    start: usize,
    faults: &'d Faults<'d>,
}

/// Models that vehicles of one type may have.
pub(crate) struct ModelChoice<'d> {
    /// The recording's vType.
    pub(crate) kind: &'d str,
    /// At least one.
    pub(crate) names: Vec<&'d str>,
    /// What else is said of them.
    pub(crate) section: Section<'d>,
}

type Value<'d> = Spanned<DeValue<'d>>;

impl<'d> Section<'d> {
    /// The file itself. Unknown keys are noted at once, here and in every section opened from it.
    pub(crate) fn root(table: &'d DeTable<'d>, known: &'static Table, faults: &'d Faults<'d>) -> Self {
        Self { table: Some(table), known, place: Place::Scene, start: 0, faults }.checked()
    }

    /// The table of that name below this one.
    pub(crate) fn section(&self, known: &'static Table) -> Section<'d> {
        let key = known.name.rsplit('.').next().unwrap_or(known.name);
        let found = self.find(key);
        let table = found.and_then(|value| match value.get_ref() {
            DeValue::Table(table) => Some(table),
            other => {
                self.wrong_type(key_of(known), "a table", other, value.span());
                None
            }
        });
        let start = found.map_or(self.start, |value| value.span().start);
        Section { table, known, place: Place::Table(known.name), start, faults: self.faults }.checked()
    }

    /// The tables of an array of tables, each placed by its `id` or its number.
    pub(crate) fn sections(&self, known: &'static Table) -> Vec<Section<'d>> {
        let Some(value) = self.find(key_of(known)) else { return vec![] };
        let DeValue::Array(array) = value.get_ref() else {
            let expected = "an array of tables, each under a heading in double brackets";
            self.wrong_type(key_of(known), expected, value.get_ref(), value.span());
            return vec![];
        };
        let numbered = array.iter().enumerate();
        numbered.filter_map(|(i, element)| self.element(known, i, element)).collect()
    }

    /// The tables of a table whose keys are names of materials.
    pub(crate) fn materials(&self) -> Vec<(&'d str, Section<'d>)> {
        let known = &keys::MATERIAL;
        let Some(value) = self.find(known.name) else { return vec![] };
        let DeValue::Table(table) = value.get_ref() else {
            self.wrong_type(known.name, "a table of materials", value.get_ref(), value.span());
            return vec![];
        };
        let material = |(name, value): (&'d Spanned<DeString<'d>>, &'d Value<'d>)| {
            let name: &'d str = name.get_ref().as_ref();
            let place = Place::Material(name.to_owned());
            let DeValue::Table(table) = value.get_ref() else {
                let expected = "a table such as { substance = \"glass\", thickness_mm = 5.0 }";
                let rule = Rule::WrongType { key: "material", expected, found: type_of(value.get_ref()) };
                self.faults.note(value.span().start, place, rule);
                return None;
            };
            let start = value.span().start;
            Some((name, Section { table: Some(table), known, place, start, faults: self.faults }.checked()))
        };
        table.iter().filter_map(material).collect()
    }

    /// What the `models` of recorded traffic say: for each type a name, a list of names, or a table with
    /// more.
    pub(crate) fn model_choices(&self) -> Vec<ModelChoice<'d>> {
        let Some(value) = self.find("models") else { return vec![] };
        let DeValue::Table(table) = value.get_ref() else {
            self.wrong_type("models", "a table such as { car = \"car-suv\" }", value.get_ref(), value.span());
            return vec![];
        };
        table.iter().filter_map(|(kind, value)| self.model_choice(kind.get_ref().as_ref(), value)).collect()
    }

    fn model_choice(&self, kind: &'d str, value: &'d Value<'d>) -> Option<ModelChoice<'d>> {
        let table = if let DeValue::Table(table) = value.get_ref() { Some(table) } else { None };
        let (place, start) = (Place::Table("traffic.models"), value.span().start);
        let known = &keys::MODEL_OF_TYPE;
        let section = Section { table, known, place, start, faults: self.faults }.checked();
        if table.is_some() {
            section.require("model");
        }
        let written = if table.is_some() { section.find("model")? } else { value };
        let names = section.names(written)?;
        Some(ModelChoice { kind, names, section })
    }

    /// A text or a list of texts, not empty.
    fn names(&self, value: &'d Value<'d>) -> Option<Vec<&'d str>> {
        let names: Option<Vec<&str>> = match value.get_ref() {
            DeValue::String(name) => Some(vec![name.as_ref()]),
            DeValue::Array(names) if !names.is_empty() => names.iter().map(text_of).collect(),
            _ => None,
        };
        if names.is_none() {
            self.wrong_type("model", "a text or a list of texts in quotes", value.get_ref(), value.span());
        }
        names
    }

    /// The tables of a list of layers, in the same place as this one.
    pub(crate) fn layers(&self) -> Option<Vec<Section<'d>>> {
        // A windscreen has three, a painted bumper four.
        let layers = self.list("layers", Allowed::Between(1.0, 32.0))?;
        let layer = |value: &'d Value<'d>| {
            let DeValue::Table(table) = value.get_ref() else {
                self.wrong_type("layers", "a list of tables", value.get_ref(), value.span());
                return None;
            };
            let (place, start) = (self.place.clone(), value.span().start);
            Some(
                Section { table: Some(table), known: &keys::LAYER, place, start, faults: self.faults }
                    .checked(),
            )
        };
        layers.iter().map(layer).collect()
    }

    fn element(&self, known: &'static Table, index: usize, element: &'d Value<'d>) -> Option<Section<'d>> {
        let DeValue::Table(table) = element.get_ref() else {
            self.wrong_type(key_of(known), "an array of tables", element.get_ref(), element.span());
            return None;
        };
        let name = match table.get("id").map(|id| id.get_ref()) {
            Some(DeValue::String(id)) => id.to_string(),
            _ => format!("#{}", index + 1),
        };
        let place = match *known {
            keys::TARGET => Place::Target(name),
            keys::CLUTTER => Place::Clutter(name),
            keys::RADARS => Place::Radar(name),
            _ => Place::Table(known.name),
        };
        let start = element.span().start;
        Some(Section { table: Some(table), known, place, start, faults: self.faults }.checked())
    }

    fn checked(self) -> Self {
        for (key, _) in self.table.into_iter().flat_map(|table| table.iter()) {
            let found = key.get_ref().as_ref();
            if !self.known.keys.contains(&found) {
                self.note_at(key.span(), unknown_key(found, self.known));
            }
        }
        self
    }

    /// Whether the key is there at all.
    pub(crate) fn has(&self, key: &'static str) -> bool {
        self.find(key).is_some()
    }

    /// Whether the table itself is there.
    pub(crate) fn exists(&self) -> bool {
        self.table.is_some()
    }

    /// Line of the table's heading.
    pub(crate) fn line(&self) -> u32 {
        self.faults.line(self.start)
    }

    /// Note a broken rule at the value of `key`, or at the table's heading where the key is absent.
    pub(crate) fn note(&self, key: &'static str, rule: Rule) {
        let byte = self.find(key).map_or(self.start, |value| value.span().start);
        self.faults.note(byte, self.place.clone(), rule);
    }

    /// Note it if `key` is missing.
    pub(crate) fn require(&self, key: &'static str) {
        if !self.has(key) {
            self.note(key, Rule::Missing { key });
        }
    }

    /// A finite number in its range; `None` where absent or wrong.
    pub(crate) fn number(&self, key: &'static str, allowed: Allowed) -> Option<f64> {
        let value = self.find(key)?;
        let Some(number) = number_of(value.get_ref()) else {
            self.wrong_type(key, "a number", value.get_ref(), value.span());
            return None;
        };
        self.in_range(key, number, allowed, value.span())
    }

    /// A whole number in its range; `None` where absent or wrong.
    pub(crate) fn integer(&self, key: &'static str, allowed: Allowed) -> Option<u64> {
        let value = self.find(key)?;
        self.integer_in(key, value, allowed)
    }

    /// A text; `None` where absent or wrong.
    pub(crate) fn text(&self, key: &'static str) -> Option<&'d str> {
        let value = self.find(key)?;
        match value.get_ref() {
            DeValue::String(text) => Some(text.as_ref()),
            other => {
                self.wrong_type(key, "a text in quotes", other, value.span());
                None
            }
        }
    }

    /// `true` or `false`; `None` where absent or wrong.
    pub(crate) fn truth(&self, key: &'static str) -> Option<bool> {
        let value = self.find(key)?;
        match value.get_ref() {
            DeValue::Boolean(truth) => Some(*truth),
            other => {
                self.wrong_type(key, "true or false", other, value.span());
                None
            }
        }
    }

    /// A name that can become a file's, a table's cell and a JSON key; `None` where absent or wrong.
    pub(crate) fn name(&self, key: &'static str) -> Option<&'d str> {
        let name = self.text(key)?;
        let plain = |c: char| c.is_alphanumeric() || " -_.+()".contains(c);
        let good = (1..=64).contains(&name.chars().count())
            && name.chars().all(plain)
            && !name.starts_with(['.', ' ']);
        if !good {
            self.note(key, Rule::BadName { key, found: name.to_owned() });
        }
        good.then_some(name)
    }

    /// What a word stands for; `None` where absent or wrong.
    pub(crate) fn word<T: Copy>(&self, key: &'static str, known: &[(&'static str, T)]) -> Option<T> {
        let found = self.text(key)?;
        let meaning = known.iter().find(|(word, _)| *word == found).map(|(_, meaning)| *meaning);
        if meaning.is_none() {
            self.unknown_word(key, found, known.iter().map(|(word, _)| *word).collect());
        }
        meaning
    }

    pub(crate) fn unknown_word(&self, key: &'static str, found: &str, known: Vec<&'static str>) {
        self.note(key, Rule::UnknownWord { key, found: found.to_owned(), known });
    }

    /// Exactly `N` numbers, each in the range; `None` where absent or wrong.
    pub(crate) fn vector<const N: usize>(&self, key: &'static str, allowed: Allowed) -> Option<[f64; N]> {
        let numbers = self.list(key, Allowed::Between(N as f64, N as f64))?;
        let numbers: Option<Vec<f64>> =
            numbers.iter().map(|value| self.number_in(key, value, allowed)).collect();
        numbers?.try_into().ok()
    }

    /// Exactly `N` whole numbers, each in the range; `None` where absent or wrong.
    pub(crate) fn counts<const N: usize>(&self, key: &'static str, allowed: Allowed) -> Option<[u64; N]> {
        let numbers = self.list(key, Allowed::Between(N as f64, N as f64))?;
        let numbers: Option<Vec<u64>> =
            numbers.iter().map(|value| self.integer_in(key, value, allowed)).collect();
        numbers?.try_into().ok()
    }

    /// A list of numbers of allowed length, each in the range; `None` where absent or wrong.
    pub(crate) fn numbers(&self, key: &'static str, length: Allowed, allowed: Allowed) -> Option<Vec<f64>> {
        self.list(key, length)?.iter().map(|value| self.number_in(key, value, allowed)).collect()
    }

    /// A list of pairs of numbers; `None` where absent or wrong.
    pub(crate) fn pairs(
        &self,
        key: &'static str,
        length: Allowed,
        allowed: Allowed,
    ) -> Option<Vec<[f64; 2]>> {
        self.list(key, length)?.iter().map(|value| self.pair(key, value, allowed)).collect()
    }

    fn pair(&self, key: &'static str, value: &Value<'d>, allowed: Allowed) -> Option<[f64; 2]> {
        let DeValue::Array(pair) = value.get_ref() else {
            self.wrong_type(key, "a list of pairs of numbers", value.get_ref(), value.span());
            return None;
        };
        if pair.len() != 2 {
            let expected = Allowed::Between(2.0, 2.0);
            self.note_at(value.span(), Rule::WrongLength { key, expected, found: pair.len() });
            return None;
        }
        let numbers: Option<Vec<f64>> =
            pair.iter().map(|value| self.number_in(key, value, allowed)).collect();
        numbers?.try_into().ok()
    }

    fn list(&self, key: &'static str, length: Allowed) -> Option<&'d [Value<'d>]> {
        let value = self.find(key)?;
        let DeValue::Array(array) = value.get_ref() else {
            self.wrong_type(key, "a list", value.get_ref(), value.span());
            return None;
        };
        if !length.holds(array.len() as f64) {
            self.note_at(value.span(), Rule::WrongLength { key, expected: length, found: array.len() });
            return None;
        }
        Some(array)
    }

    fn number_in(&self, key: &'static str, value: &Value<'d>, allowed: Allowed) -> Option<f64> {
        let Some(number) = number_of(value.get_ref()) else {
            self.wrong_type(key, "a list of numbers", value.get_ref(), value.span());
            return None;
        };
        self.in_range(key, number, allowed, value.span())
    }

    fn integer_in(&self, key: &'static str, value: &Value<'d>, allowed: Allowed) -> Option<u64> {
        let DeValue::Integer(integer) = value.get_ref() else {
            self.wrong_type(key, "a whole number", value.get_ref(), value.span());
            return None;
        };
        let exact = i128::from_str_radix(integer.as_str(), integer.radix()).ok();
        // Beyond i128 the sign is all that matters: the range refuses it.
        let beyond = if integer.as_str().starts_with('-') { f64::NEG_INFINITY } else { f64::INFINITY };
        self.in_range(key, exact.map_or(beyond, |exact| exact as f64), allowed, value.span())?;
        exact.and_then(|exact| u64::try_from(exact).ok())
    }

    fn in_range(&self, key: &'static str, found: f64, allowed: Allowed, span: Range<usize>) -> Option<f64> {
        if allowed.holds(found) {
            return Some(found);
        }
        self.note_at(span, Rule::OutOfRange { key, found, allowed });
        None
    }

    fn wrong_type(&self, key: &'static str, expected: &'static str, found: &DeValue<'_>, span: Range<usize>) {
        self.note_at(span, Rule::WrongType { key, expected, found: type_of(found) });
    }

    fn note_at(&self, span: Range<usize>, rule: Rule) {
        self.faults.note(span.start, self.place.clone(), rule);
    }

    fn find(&self, key: &str) -> Option<&'d Value<'d>> {
        self.table.and_then(|table| table.get(key))
    }
}

fn key_of(table: &'static Table) -> &'static str {
    table.name.rsplit('.').next().unwrap_or(table.name)
}

fn unknown_key(found: &str, table: &Table) -> Rule {
    let found_here = found.to_owned();
    let here = |nearest| Rule::UnknownKey { found: found_here.clone(), nearest, home: None };
    if let Some(meant) = synonyms::meant(found, table) {
        return here(Some(meant));
    }
    if let Some(home) = keys::home_of(found, table) {
        return Rule::WrongTable { found: found_here, table: home };
    }
    // Four letters in five alike are no chance; less may be, and a word of others is none.
    const ALIKE: f64 = 0.85;
    match (nearest_from(ALIKE, found, table.keys), synonyms::meant_elsewhere(found)) {
        (None, Some(meant)) => {
            Rule::UnknownKey { found: found_here, nearest: Some(meant), home: keys::home_of(meant, table) }
        }
        _ => here(nearest(found, table.keys)),
    }
}

fn text_of<'d>(value: &'d Value<'d>) -> Option<&'d str> {
    if let DeValue::String(text) = value.get_ref() { Some(text.as_ref()) } else { None }
}

fn number_of(value: &DeValue<'_>) -> Option<f64> {
    match value {
        // An integer of any radix; a decimal one also where it exceeds 64 bits.
        DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
            .map_or_else(|_| integer.as_str().parse().ok(), |i| Some(i as f64)),
        DeValue::Float(float) => float.as_str().parse().ok(),
        _ => None,
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
