//! A key of a scene file: its name, its values, its default, and its sentence.

use serde_json::Value;
use toml::de::DeValue;

/// Values that a key takes, as the page and the schema tell it.
pub trait ValueKind: Copy + 'static {
    /// Whether it is a number or a list of them.
    const NUMBERS: bool = false;
    /// Allowed values in the words of the page.
    fn allowed(&self) -> String;
    /// Allowed values in JSON Schema.
    fn schema(&self) -> Value;
}

/// A kind of which a value can stand for one that is left out.
pub trait Defaultable: ValueKind {
    /// Type of a value as it is read.
    type Value: Copy + 'static;
    /// Value as JSON, which is also TOML.
    fn json(&self, value: Self::Value) -> Value;
    /// Allowed values in the words of the page; among several words the default comes first.
    fn allowed_beside(&self, _default: Self::Value) -> String {
        self.allowed()
    }
}

/// A key. `A` is [`Absent`], or [`DefaultValue`] with a default value common to all readers.
#[derive(Clone, Copy)]
pub struct Key<K, A = Absent> {
    /// Name as written, with its unit.
    pub name: &'static str,
    /// Type and range.
    pub takes: K,
    /// Value or meaning of the key where it is left out.
    pub absent: A,
    /// Text of the page in place of the kind's own words, which stand for `{}` in it.
    allowed: &'static str,
    meaning: &'static str,
}

/// Meaning of an omitted key.
#[derive(Clone, Copy)]
pub enum Absent {
    /// An error.
    Required,
    /// Nothing; the page has a dash.
    Nothing,
    /// A text of the page, because the meaning depends on other keys.
    Explained(&'static str),
}

/// The value of an omitted key.
#[derive(Clone, Copy)]
pub struct DefaultValue<V>(pub V);

impl<K: Copy> Key<K> {
    /// A key that may be left out; a sentence as in the page's last column.
    pub const fn new(name: &'static str, takes: K, meaning: &'static str) -> Self {
        Self { name, takes, absent: Absent::Nothing, allowed: "{}", meaning }
    }

    /// One without which nothing can be said.
    pub const fn required(self) -> Self {
        Self { absent: Absent::Required, ..self }
    }

    /// Describes the meaning of the omitted key, which depends on others.
    pub(crate) const fn absent(self, said: &'static str) -> Self {
        Self { absent: Absent::Explained(said), ..self }
    }

    /// One with a value where it is left out.
    pub const fn with_default<V: Copy>(self, value: V) -> Key<K, DefaultValue<V>> {
        let Self { name, takes, allowed, meaning, .. } = self;
        Key { name, takes, absent: DefaultValue(value), allowed, meaning }
    }
}

impl<K: Copy, A: Copy> Key<K, A> {
    /// Sets a text that describes the allowed values in more detail than the kind, whose words replace `{}`.
    pub(crate) const fn allowed(self, allowed: &'static str) -> Self {
        Self { allowed, ..self }
    }
}

/// A key of any kind, as a table lists it.
pub trait Entry {
    /// Name of the key as written.
    fn name(&self) -> &'static str;
    /// Whether a table without the key is refused.
    fn is_required(&self) -> bool;
    /// Whether it accepts a number or a list of numbers.
    fn holds_numbers(&self) -> bool;
    /// Default, allowed values and meaning, as in the page's row.
    fn cells(&self) -> [String; 3];
    /// The schema of its values, without sentence and default.
    fn values(&self) -> Value;
    /// Value of the omitted key, if it is always the same.
    fn default(&self) -> Option<Value>;
}

impl<K: ValueKind> Entry for Key<K> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn is_required(&self) -> bool {
        matches!(self.absent, Absent::Required)
    }

    fn holds_numbers(&self) -> bool {
        K::NUMBERS
    }

    fn cells(&self) -> [String; 3] {
        let absent = match self.absent {
            Absent::Required => "required",
            Absent::Nothing => "–",
            Absent::Explained(said) => said,
        };
        [absent.to_owned(), self.allowed.replace("{}", &self.takes.allowed()), self.meaning.to_owned()]
    }

    fn values(&self) -> Value {
        self.takes.schema()
    }

    fn default(&self) -> Option<Value> {
        None
    }
}

impl<K: Defaultable> Entry for Key<K, DefaultValue<K::Value>> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn is_required(&self) -> bool {
        false
    }

    fn holds_numbers(&self) -> bool {
        K::NUMBERS
    }

    fn cells(&self) -> [String; 3] {
        let default = written(&self.takes.json(self.absent.0));
        let allowed = self.takes.allowed_beside(self.absent.0);
        [default, self.allowed.replace("{}", &allowed), self.meaning.to_owned()]
    }

    fn values(&self) -> Value {
        self.takes.schema()
    }

    fn default(&self) -> Option<Value> {
        Some(self.takes.json(self.absent.0))
    }
}

/// A value in TOML as a person writes it.
fn written(value: &Value) -> String {
    match (value.as_array(), value.as_f64().filter(|_| value.is_f64())) {
        (Some(list), _) => format!("[{}]", list.iter().map(written).collect::<Vec<_>>().join(", ")),
        (None, Some(number)) => format!("{number:?}"),
        (None, None) => value.to_string(),
    }
}

/// A table of a scene file and the keys it may hold.
#[derive(Clone, Copy)]
pub struct Table {
    /// Dotted name; empty for the keys before the first table.
    pub name: &'static str,
    /// Heading as written in the file.
    pub heading: &'static str,
    /// Description of the table, in a sentence.
    pub about: &'static str,
    /// Keys, tables below it included, in the order of the page.
    pub keys: &'static [&'static dyn Entry],
}

impl Table {
    /// Names of the table's keys.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.keys.iter().map(|key| key.name())
    }

    /// Names of the keys that accept a number or a list of numbers.
    pub fn numbers(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.keys.iter().filter(|key| key.holds_numbers()).map(|key| key.name())
    }

    /// Names of the keys that accept the name of a file.
    pub fn files(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.keys
            .iter()
            .filter(|key| key.cells()[1].split(' ').any(|word| word == "file"))
            .map(|key| key.name())
    }

    /// Whether it has a key with that name.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.names().any(|known| known == name)
    }

    /// Whether it has a key with that name which takes values of the type of `value`.
    pub(crate) fn takes(&self, name: &str, value: &DeValue<'_>) -> bool {
        self.keys.iter().any(|key| key.name() == name && has_type(&key.values(), value))
    }
}

/// Whether a schema describes values of the type of `value`. A reference is to the schema of a table.
fn has_type(schema: &Value, value: &DeValue<'_>) -> bool {
    if let Some(alternatives) = schema["anyOf"].as_array() {
        return alternatives.iter().any(|one| has_type(one, value));
    }
    let known = schema["type"].as_str().unwrap_or("object");
    match value {
        DeValue::String(_) => known == "string",
        DeValue::Integer(_) => matches!(known, "integer" | "number"),
        DeValue::Float(_) => known == "number",
        DeValue::Boolean(_) => known == "boolean",
        DeValue::Array(_) => known == "array",
        DeValue::Table(_) => known == "object",
        DeValue::Datetime(_) => false,
    }
}
