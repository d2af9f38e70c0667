//! Values of a scene's tables, each read according to its key.

use crate::document::errors::Rule;
use crate::document::keys::key::{DefaultValue, Defaultable, Key, ValueKind};
use crate::document::keys::kinds::{
    Boolean, Choice, ChoiceOrPattern, Integer, IntegerVector, Integers, Name, Number, Numbers, Pair, Pairs,
    PerElement, Text, Texts, Vector,
};
use crate::document::section::{Section, SpannedValue};
use crate::wording::allowed_range::AllowedRange;
use toml::de::DeValue;

/// A kind of which values are read.
pub trait ReadableKind<'d>: ValueKind {
    /// Type of the value that is read.
    type Read;
    /// Reads the value of `key`; notes a fault and returns `None` if it is wrong.
    fn from(
        &self,
        section: &Section<'d>,
        key: &'static str,
        value: &'d SpannedValue<'d>,
    ) -> Option<Self::Read>;
}

impl<'d> Section<'d> {
    /// Reads the value of a key; `None` where absent or wrong.
    pub fn read<K: ReadableKind<'d>, A>(&self, key: &Key<K, A>) -> Option<K::Read> {
        key.takes.from(self, key.name, self.find(key.name)?)
    }

    /// Reads the value of a key, which is its default where absent or wrong.
    pub fn or_default<K>(
        &self,
        key: &Key<K, DefaultValue<<K as Defaultable>::Value>>,
    ) -> <K as Defaultable>::Value
    where
        K: Defaultable + ReadableKind<'d, Read = <K as Defaultable>::Value>,
    {
        self.read(key).unwrap_or(key.absent.0)
    }

    /// A number for each of `count` elements; `None` where absent or wrong.
    pub(crate) fn of_elements(&self, key: &Key<PerElement>, count: usize) -> Option<Vec<f64>> {
        let numbers = Numbers { length: exactly(count), each: key.takes.0 };
        numbers.from(self, key.name, self.find(key.name)?)
    }

    fn number_in(&self, key: &'static str, value: &SpannedValue<'d>, allowed: AllowedRange) -> Option<f64> {
        let Some(number) = number_of(value.get_ref()) else {
            self.wrong_type(key, "a list of numbers", value);
            return None;
        };
        self.in_range(key, number, allowed, value)
    }

    fn integer_in(&self, key: &'static str, value: &SpannedValue<'d>, allowed: AllowedRange) -> Option<u64> {
        let DeValue::Integer(integer) = value.get_ref() else {
            self.wrong_type(key, "a whole number", value);
            return None;
        };
        let exact = i128::from_str_radix(integer.as_str(), integer.radix()).ok();
        // Beyond i128 only the sign matters, because the range refuses it.
        let beyond = if integer.as_str().starts_with('-') { f64::NEG_INFINITY } else { f64::INFINITY };
        self.in_range(key, exact.map_or(beyond, |exact| exact as f64), allowed, value)?;
        // As an f64, the type of the range, 2⁶³ equals the integer before it.
        if exact.is_some_and(|exact| exact > i64::MAX.into()) {
            self.note_at(value.span(), Rule::BeyondWholeNumbers { key });
            return None;
        }
        exact.and_then(|exact| u64::try_from(exact).ok())
    }

    fn in_range(
        &self,
        key: &'static str,
        found: f64,
        allowed: AllowedRange,
        value: &SpannedValue<'d>,
    ) -> Option<f64> {
        if allowed.holds(found) {
            return Some(found);
        }
        self.note_at(value.span(), Rule::OutOfRange { key, found, allowed });
        None
    }
}

impl<'d> ReadableKind<'d> for Number {
    type Read = f64;

    fn from(&self, section: &Section<'d>, key: &'static str, value: &'d SpannedValue<'d>) -> Option<f64> {
        let Some(number) = number_of(value.get_ref()) else {
            section.wrong_type(key, "a number", value);
            return None;
        };
        section.in_range(key, number, self.0, value)
    }
}

impl<'d> ReadableKind<'d> for Integer {
    type Read = u64;

    fn from(&self, section: &Section<'d>, key: &'static str, value: &'d SpannedValue<'d>) -> Option<u64> {
        section.integer_in(key, value, self.0)
    }
}

impl<'d> ReadableKind<'d> for Text {
    type Read = &'d str;

    fn from(&self, section: &Section<'d>, key: &'static str, value: &'d SpannedValue<'d>) -> Option<&'d str> {
        let text = text_of(value);
        if text.is_none() {
            section.wrong_type(key, "a text in quotes", value);
        }
        text
    }
}

impl<'d> ReadableKind<'d> for Texts {
    type Read = Vec<&'d str>;

    fn from(
        &self,
        section: &Section<'d>,
        key: &'static str,
        value: &'d SpannedValue<'d>,
    ) -> Option<Vec<&'d str>> {
        match value.get_ref() {
            DeValue::String(text) => Some(vec![text.as_ref()]),
            DeValue::Array(texts) if !texts.is_empty() => {
                let other = texts.iter().find(|text| text_of(text).is_none());
                other
                    .into_iter()
                    .for_each(|other| section.wrong_type(key, "a list of texts in quotes", other));
                texts.iter().map(text_of).collect()
            }
            DeValue::Array(_) => {
                let expected = "a text or a list of texts in quotes";
                section.note_at(value.span(), Rule::WrongType { key, expected, found: "an empty list" });
                None
            }
            _ => {
                section.wrong_type(key, "a text or a list of texts in quotes", value);
                None
            }
        }
    }
}

impl<'d> ReadableKind<'d> for Boolean {
    type Read = bool;

    fn from(&self, section: &Section<'d>, key: &'static str, value: &'d SpannedValue<'d>) -> Option<bool> {
        if let DeValue::Boolean(truth) = value.get_ref() {
            return Some(*truth);
        }
        section.wrong_type(key, "true or false", value);
        None
    }
}

impl<'d> ReadableKind<'d> for Name {
    type Read = &'d str;

    fn from(&self, section: &Section<'d>, key: &'static str, value: &'d SpannedValue<'d>) -> Option<&'d str> {
        let name = Text("a name").from(section, key, value)?;
        let plain = |c: char| c.is_alphanumeric() || " -_.+()".contains(c);
        let good = (1..=64).contains(&name.chars().count())
            && name.chars().all(plain)
            && !name.starts_with(['.', ' ']);
        if !good {
            section.note_at(value.span(), Rule::BadName { key, found: name.to_owned() });
        }
        good.then_some(name)
    }
}

impl<'d, T: Copy + PartialEq> ReadableKind<'d> for Choice<T> {
    type Read = T;

    fn from(&self, section: &Section<'d>, key: &'static str, value: &'d SpannedValue<'d>) -> Option<T> {
        ChoiceOrPattern { words: *self, built: |_| None, others: "", pattern: "" }.from(section, key, value)
    }
}

impl<'d, T: Copy + PartialEq> ReadableKind<'d> for ChoiceOrPattern<T> {
    type Read = T;

    fn from(&self, section: &Section<'d>, key: &'static str, value: &'d SpannedValue<'d>) -> Option<T> {
        let found = Text("a word").from(section, key, value)?;
        let known = (self.words.0)();
        let told = known.iter().find(|(word, _)| *word == found).map(|(_, meaning)| *meaning);
        let meaning = told.or_else(|| (self.built)(found));
        if meaning.is_none() {
            let known = known.iter().map(|(word, _)| *word).collect();
            let (found, others) = (found.to_owned(), self.others);
            section.note_at(value.span(), Rule::UnknownWord { key, found, known, others });
        }
        meaning
    }
}

impl<'d, const N: usize> ReadableKind<'d> for Vector<N> {
    type Read = [f64; N];

    fn from(
        &self,
        section: &Section<'d>,
        key: &'static str,
        value: &'d SpannedValue<'d>,
    ) -> Option<[f64; N]> {
        let numbers = Numbers { length: exactly(N), each: self.0 };
        numbers.from(section, key, value)?.try_into().ok()
    }
}

impl<'d, const N: usize> ReadableKind<'d> for IntegerVector<N> {
    type Read = [u64; N];

    fn from(
        &self,
        section: &Section<'d>,
        key: &'static str,
        value: &'d SpannedValue<'d>,
    ) -> Option<[u64; N]> {
        let numbers = section.list(key, value, exactly(N))?;
        let numbers: Option<Vec<u64>> =
            numbers.iter().map(|value| section.integer_in(key, value, self.0)).collect();
        numbers?.try_into().ok()
    }
}

impl<'d> ReadableKind<'d> for Numbers {
    type Read = Vec<f64>;

    fn from(
        &self,
        section: &Section<'d>,
        key: &'static str,
        value: &'d SpannedValue<'d>,
    ) -> Option<Vec<f64>> {
        let numbers = section.list(key, value, self.length)?;
        numbers.iter().map(|value| section.number_in(key, value, self.each)).collect()
    }
}

impl<'d> ReadableKind<'d> for Integers {
    type Read = Vec<u64>;

    fn from(
        &self,
        section: &Section<'d>,
        key: &'static str,
        value: &'d SpannedValue<'d>,
    ) -> Option<Vec<u64>> {
        let numbers = section.list(key, value, self.length)?;
        numbers.iter().map(|value| section.integer_in(key, value, self.each)).collect()
    }
}

impl<'d> ReadableKind<'d> for Pair {
    type Read = [f64; 2];

    fn from(
        &self,
        section: &Section<'d>,
        key: &'static str,
        value: &'d SpannedValue<'d>,
    ) -> Option<[f64; 2]> {
        Vector(self.any).from(section, key, value)
    }
}

impl<'d> ReadableKind<'d> for Pairs {
    type Read = Vec<[f64; 2]>;

    fn from(
        &self,
        section: &Section<'d>,
        key: &'static str,
        value: &'d SpannedValue<'d>,
    ) -> Option<Vec<[f64; 2]>> {
        let pair = |value: &'d SpannedValue<'d>| {
            if value.get_ref().as_array().is_none() {
                section.wrong_type(key, "a list of pairs of numbers", value);
                return None;
            }
            self.pair.from(section, key, value)
        };
        section.list(key, value, self.length)?.iter().map(pair).collect()
    }
}

fn exactly(count: usize) -> AllowedRange {
    AllowedRange::Between(count as f64, count as f64)
}

fn text_of<'d>(value: &'d SpannedValue<'d>) -> Option<&'d str> {
    if let DeValue::String(text) = value.get_ref() { Some(text.as_ref()) } else { None }
}

fn number_of(value: &DeValue<'_>) -> Option<f64> {
    match value {
        // An integer of any radix, including a decimal one of more than 64 bits.
        DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
            .map_or_else(|_| integer.as_str().parse().ok(), |i| Some(i as f64)),
        DeValue::Float(float) => float.as_str().parse().ok(),
        _ => None,
    }
}
