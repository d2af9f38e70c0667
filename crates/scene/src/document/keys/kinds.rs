//! Kinds of values of keys: numbers in a range, words of a list, texts, lists and tables.

use crate::document::keys::key::{Defaultable, Table, ValueKind};
use crate::wording::allowed_range::AllowedRange;
use crate::wording::number;
use artifact::settings::Class;
use serde_json::{Value, json};

/// A number.
#[derive(Clone, Copy)]
pub struct Number(pub AllowedRange);

/// A whole number.
#[derive(Clone, Copy)]
pub struct Integer(pub AllowedRange);

/// A number in one of two ranges, depending on another key.
#[derive(Clone, Copy)]
pub(crate) struct Either(pub(crate) [Number; 2]);

/// `true` or `false`.
#[derive(Clone, Copy)]
pub struct Boolean;

/// A text, and the kind of thing that it names.
#[derive(Clone, Copy)]
pub struct Text(pub &'static str);

/// A text or a list of texts, not empty, and the kind of thing that they name.
#[derive(Clone, Copy)]
pub struct Texts(pub &'static str);

/// A name that is usable as a file name, a table's cell and a JSON key.
#[derive(Clone, Copy)]
pub(crate) struct Name;

impl Name {
    /// Expression that every name matches. Letters are those of any script, which no expression lists that
    /// every editor reads; beyond ASCII only control characters are excluded here, other marks by the reader.
    const PATTERN: &str = r"^[^\u0000-'*,./:-@\[-\^`{-\u009f][^\u0000-\u001f!-'*,/:-@\[-\^`{-\u009f]*$";
}

/// Words, and the value of each.
#[derive(Clone, Copy)]
pub struct Choice<T: 'static>(pub(crate) fn() -> Vec<(&'static str, T)>);

impl Choice<Class> {
    /// Classes of vehicles.
    pub const CLASSES: Self = Self(|| Class::ALL.map(|class| (class.name(), class)).to_vec());
}

/// Words, and others that follow a pattern.
#[derive(Clone, Copy)]
pub(crate) struct ChoiceOrPattern<T: 'static> {
    /// The words listed in errors and on the page.
    pub(crate) words: Choice<T>,
    /// Value of any other word.
    pub(crate) built: fn(&str) -> Option<T>,
    /// End of a sentence that lists the words: description of the others.
    pub(crate) others: &'static str,
    /// A regular expression that all other words match.
    pub(crate) pattern: &'static str,
}

/// `N` numbers, each in the range.
#[derive(Clone, Copy)]
pub struct Vector<const N: usize>(pub AllowedRange);

/// `N` whole numbers, each in the range.
#[derive(Clone, Copy)]
pub struct IntegerVector<const N: usize>(pub AllowedRange);

/// Two numbers, each in its own range.
#[derive(Clone, Copy)]
pub(crate) struct Pair {
    /// Range of either number, checked at the position of the number.
    pub(crate) any: AllowedRange,
    /// Ranges of the first and of the second number, checked at the position of the list.
    pub(crate) each: [AllowedRange; 2],
}

/// A list of numbers.
#[derive(Clone, Copy)]
pub(crate) struct Numbers {
    /// Allowed length of the list.
    pub(crate) length: AllowedRange,
    /// Range of each number.
    pub(crate) each: AllowedRange,
}

/// A list of whole numbers.
#[derive(Clone, Copy)]
pub struct Integers {
    /// Allowed length of the list.
    pub length: AllowedRange,
    /// Range of each number.
    pub each: AllowedRange,
}

/// A list of pairs of numbers.
#[derive(Clone, Copy)]
pub(crate) struct Pairs {
    /// Allowed length of the list.
    pub(crate) length: AllowedRange,
    /// Ranges of each pair.
    pub(crate) pair: Pair,
}

/// A number for each element of an array.
#[derive(Clone, Copy)]
pub(crate) struct PerElement(pub(crate) AllowedRange);

/// Nested tables with the keys of `table`.
#[derive(Clone, Copy)]
pub struct Subtables {
    /// Form in which they are written.
    pub form: TableForm,
    /// The keys of each.
    pub table: &'static Table,
}

/// Form in which tables are written.
#[derive(Clone, Copy)]
pub enum TableForm {
    /// One table.
    One,
    /// An array of tables.
    Several,
    /// A list of tables of allowed length.
    List(AllowedRange),
    /// Tables under names given by the scene.
    Named,
    /// Tables under names given by the scene, or texts in their place.
    NamedOrTexts,
}

impl Subtables {
    /// One table.
    pub const fn one(table: &'static Table) -> Self {
        Self { form: TableForm::One, table }
    }

    /// An array of tables.
    pub const fn several(table: &'static Table) -> Self {
        Self { form: TableForm::Several, table }
    }
}

impl ValueKind for Number {
    const NUMBERS: bool = true;

    fn allowed(&self) -> String {
        range(self.0)
    }

    fn schema(&self) -> Value {
        bounds("number", self.0)
    }
}

impl ValueKind for Integer {
    const NUMBERS: bool = true;

    fn allowed(&self) -> String {
        range(self.0)
    }

    fn schema(&self) -> Value {
        bounds("integer", self.0)
    }
}

impl ValueKind for Either {
    const NUMBERS: bool = true;

    fn allowed(&self) -> String {
        self.0.map(|number| number.allowed()).join(", ")
    }

    fn schema(&self) -> Value {
        json!({ "anyOf": self.0.map(|number| number.schema()) })
    }
}

impl ValueKind for Boolean {
    fn allowed(&self) -> String {
        "true, false".to_owned()
    }

    fn schema(&self) -> Value {
        json!({ "type": "boolean" })
    }
}

impl ValueKind for Text {
    fn allowed(&self) -> String {
        self.0.to_owned()
    }

    fn schema(&self) -> Value {
        json!({ "type": "string" })
    }
}

impl ValueKind for Texts {
    fn allowed(&self) -> String {
        self.0.to_owned()
    }

    fn schema(&self) -> Value {
        json!({ "anyOf": texts() })
    }
}

impl ValueKind for Name {
    fn allowed(&self) -> String {
        "1 to 64 letters, digits, spaces or any of `-_.+()`, the first no dot or space".to_owned()
    }

    fn schema(&self) -> Value {
        json!({ "type": "string", "minLength": 1, "maxLength": 64, "pattern": Self::PATTERN })
    }
}

impl<T: Copy + PartialEq> ValueKind for Choice<T> {
    fn allowed(&self) -> String {
        quoted(&(self.0)())
    }

    fn schema(&self) -> Value {
        json!({ "type": "string", "enum": (self.0)().iter().map(|(word, _)| *word).collect::<Vec<_>>() })
    }
}

impl<T: Copy + PartialEq> ValueKind for ChoiceOrPattern<T> {
    fn allowed(&self) -> String {
        self.words.allowed() + self.others
    }

    fn schema(&self) -> Value {
        json!({ "anyOf": [self.words.schema(), { "type": "string", "pattern": self.pattern }] })
    }
}

impl<const N: usize> ValueKind for Vector<N> {
    const NUMBERS: bool = true;

    fn allowed(&self) -> String {
        range(self.0)
    }

    fn schema(&self) -> Value {
        list(&bounds("number", self.0), exactly(N))
    }
}

impl<const N: usize> ValueKind for IntegerVector<N> {
    const NUMBERS: bool = true;

    fn allowed(&self) -> String {
        range(self.0)
    }

    fn schema(&self) -> Value {
        list(&bounds("integer", self.0), exactly(N))
    }
}

impl ValueKind for Pair {
    const NUMBERS: bool = true;

    fn allowed(&self) -> String {
        format!("[{}]", self.each.map(range).map(|range| range.replace(',', "")).join(", "))
    }

    fn schema(&self) -> Value {
        let numbers = self.each.map(|each| bounds("number", each));
        json!({ "type": "array", "items": numbers, "minItems": 2, "maxItems": 2 })
    }
}

impl ValueKind for Numbers {
    const NUMBERS: bool = true;

    fn allowed(&self) -> String {
        format!("{} values, {}", many(self.length), range(self.each))
    }

    fn schema(&self) -> Value {
        list(&bounds("number", self.each), self.length)
    }
}

impl ValueKind for Integers {
    const NUMBERS: bool = true;

    fn allowed(&self) -> String {
        format!("{} values, {}", many(self.length), range(self.each))
    }

    fn schema(&self) -> Value {
        list(&bounds("integer", self.each), self.length)
    }
}

impl ValueKind for Pairs {
    const NUMBERS: bool = true;

    fn allowed(&self) -> String {
        let [first, second] = self.pair.each;
        let each =
            if first == second { format!(", {}", range(first)) } else { format!(" {}", self.pair.allowed()) };
        format!("{} pairs{each}", many(self.length))
    }

    fn schema(&self) -> Value {
        list(&self.pair.schema(), self.length)
    }
}

impl ValueKind for PerElement {
    const NUMBERS: bool = true;

    fn allowed(&self) -> String {
        range(self.0)
    }

    fn schema(&self) -> Value {
        json!({ "type": "array", "items": bounds("number", self.0) })
    }
}

impl ValueKind for Subtables {
    fn allowed(&self) -> String {
        match self.form {
            TableForm::One | TableForm::Several | TableForm::Named => String::new(),
            TableForm::List(length) => many(length),
            TableForm::NamedOrTexts => "a table".to_owned(),
        }
    }

    fn schema(&self) -> Value {
        let (about, of_table) =
            (self.table.about, json!({ "$ref": format!("#/definitions/{}", self.table.name) }));
        match self.form {
            TableForm::One => of_table,
            TableForm::Several => json!({ "description": about, "type": "array", "items": of_table }),
            TableForm::List(length) => list(&of_table, length),
            TableForm::Named => {
                json!({ "description": about, "type": "object", "additionalProperties": of_table })
            }
            TableForm::NamedOrTexts => {
                let [text, list] = texts();
                json!({ "type": "object", "additionalProperties": { "anyOf": [text, list, of_table] } })
            }
        }
    }
}

impl Defaultable for Number {
    type Value = f64;

    fn json(&self, value: f64) -> Value {
        value.into()
    }
}

impl Defaultable for Integer {
    type Value = u64;

    fn json(&self, value: u64) -> Value {
        value.into()
    }
}

impl Defaultable for Boolean {
    type Value = bool;

    fn json(&self, value: bool) -> Value {
        value.into()
    }
}

impl Defaultable for Text {
    type Value = &'static str;

    fn json(&self, value: &'static str) -> Value {
        value.into()
    }
}

impl<T: Copy + PartialEq> Defaultable for Choice<T> {
    type Value = T;

    fn json(&self, value: T) -> Value {
        (self.0)().into_iter().find(|(_, known)| *known == value).map(|(word, _)| word).into()
    }

    fn allowed_beside(&self, default: T) -> String {
        let mut words = (self.0)();
        words.sort_by_key(|(_, value)| *value != default);
        quoted(&words)
    }
}

impl<T: Copy + PartialEq> Defaultable for ChoiceOrPattern<T> {
    type Value = T;

    fn json(&self, value: T) -> Value {
        self.words.json(value)
    }
}

impl<const N: usize> Defaultable for Vector<N> {
    type Value = [f64; N];

    fn json(&self, value: [f64; N]) -> Value {
        value.to_vec().into()
    }
}

impl<const N: usize> Defaultable for IntegerVector<N> {
    type Value = [u64; N];

    fn json(&self, value: [u64; N]) -> Value {
        value.to_vec().into()
    }
}

impl Defaultable for Numbers {
    type Value = &'static [f64];

    fn json(&self, value: &'static [f64]) -> Value {
        value.to_vec().into()
    }
}

fn quoted<T>(words: &[(&'static str, T)]) -> String {
    words.iter().map(|(word, _)| format!("\"{word}\"")).collect::<Vec<_>>().join(", ")
}

/// A range in the words of the page.
fn range(allowed: AllowedRange) -> String {
    match allowed {
        AllowedRange::Between(low, high) if low == -high => format!("±{}", figure(high)),
        AllowedRange::Between(low, high) => format!("{} to {}", figure(low), figure(high)),
        AllowedRange::Above(low, high) => format!("above {}, to {}", figure(low), figure(high)),
        AllowedRange::Inside(low, high) => format!("above {} and below {}", figure(low), figure(high)),
        AllowedRange::Below(low, high) => format!("{} up to, not including, {}", figure(low), figure(high)),
    }
}

/// The allowed length of a list in the words of the page.
fn many(length: AllowedRange) -> String {
    match length {
        AllowedRange::Between(0.0, most) => format!("up to {}", figure(most)),
        length => range(length),
    }
}

/// Writes a number; from 10⁴ on as a power if it is one.
fn figure(value: f64) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    if value == i64::MAX as f64 {
        return "2⁶³ − 1".to_owned();
    }
    match (4..16).find(|power| 10_f64.powi(*power) == value) {
        Some(power) => format!(
            "10{}",
            power.to_string().bytes().map(|b| DIGITS[usize::from(b - b'0')]).collect::<String>()
        ),
        None => number::WrittenNumber(value).to_string(),
    }
}

fn exactly(count: usize) -> AllowedRange {
    AllowedRange::Between(count as f64, count as f64)
}

fn bounds(kind: &str, allowed: AllowedRange) -> Value {
    let (least, most, low, high) = match allowed {
        AllowedRange::Between(low, high) => ("minimum", "maximum", low, high),
        AllowedRange::Above(low, high) => ("exclusiveMinimum", "maximum", low, high),
        AllowedRange::Inside(low, high) => ("exclusiveMinimum", "exclusiveMaximum", low, high),
        AllowedRange::Below(low, high) => ("minimum", "exclusiveMaximum", low, high),
    };
    json!({ "type": kind, least: shortest(low), most: shortest(high) })
}

/// Integer if it is whole; 2⁶³, which no integer of TOML reaches, is reduced by one.
fn shortest(value: f64) -> Value {
    if value.fract() == 0.0 && value.abs() <= i64::MAX as f64 { (value as i64).into() } else { value.into() }
}

fn list(items: &Value, length: AllowedRange) -> Value {
    let mut list = json!({ "type": "array", "items": items });
    if let AllowedRange::Between(least, most) = length {
        list["minItems"] = shortest(least);
        list["maxItems"] = shortest(most);
    }
    list
}

/// Schema of a text, and of a list of texts.
fn texts() -> [Value; 2] {
    let text = json!({ "type": "string" });
    [text.clone(), json!({ "type": "array", "items": text, "minItems": 1 })]
}
