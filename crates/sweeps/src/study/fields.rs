//! A table of a study's file with typed access to its keys; faults are refused with their place.

use crate::study::study_text::StudyText;
use pipeline::host::failure::Failure;
use std::ops::RangeInclusive;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Value with its place.
pub(crate) type Value<'d> = Spanned<DeValue<'d>>;

/// A table of a study's file.
pub(crate) struct Fields<'d> {
    pub(crate) page: &'d StudyText,
    /// Name of the table in errors; empty for the beginning of the file.
    pub(crate) place: String,
    /// Byte at which the table begins.
    pub(crate) at: usize,
    table: &'d DeTable<'d>,
}

impl<'d> Fields<'d> {
    /// Makes the fields of a table, which must have no other than the known keys.
    pub(crate) fn of(
        page: &'d StudyText,
        place: &str,
        at: usize,
        table: &'d DeTable<'d>,
        known: &[&str],
    ) -> Result<Self, Failure> {
        let fields = Self { page, place: place.to_owned(), at, table };
        let unknown = table.iter().find(|(key, _)| !known.contains(&key.get_ref().as_ref()));
        match unknown {
            Some((key, _)) => Err(fields.refused(key.span().start, &unknown_key(key.get_ref(), known))),
            None => Ok(fields),
        }
    }

    /// Refusal of the value at a byte.
    pub(crate) fn refused(&self, byte: usize, rule: &str) -> Failure {
        self.page.refused(byte, &self.place, rule)
    }

    /// Refusal of the table as a whole.
    pub(crate) fn refused_whole(&self, rule: &str) -> Failure {
        self.refused(self.at, rule)
    }

    pub(crate) fn value(&self, key: &str) -> Option<&'d Value<'d>> {
        self.table.get(key)
    }

    pub(crate) fn text(&self, key: &str) -> Result<Option<&'d str>, Failure> {
        self.typed(key, "a text", |value| value.as_str())
    }

    pub(crate) fn list(&self, key: &str) -> Result<Option<Vec<&'d Value<'d>>>, Failure> {
        self.typed(key, "a list", |value| Some(value.as_array()?.iter().collect()))
    }

    pub(crate) fn whole(&self, key: &str, allowed: RangeInclusive<u64>) -> Result<Option<u64>, Failure> {
        let (least, most) = (*allowed.start(), *allowed.end());
        let wanted = format!("a whole number from {least} to {most}");
        self.typed(key, &wanted, |value| whole(value).filter(|number| allowed.contains(number)))
    }

    pub(crate) fn number(&self, key: &str, allowed: RangeInclusive<f64>) -> Result<Option<f64>, Failure> {
        let wanted = format!("a number from {} to {}", allowed.start(), allowed.end());
        self.typed(key, &wanted, |value| number(value).filter(|number| allowed.contains(number)))
    }

    /// Table under a key, with no other than the known keys.
    pub(crate) fn table(&self, key: &str, known: &[&str]) -> Result<Option<Self>, Failure> {
        let table = self.typed(key, "a table", DeValue::as_table)?;
        let at = self.value(key).map_or(self.at, |value| value.span().start);
        table.map(|table| Self::of(self.page, &format!("[{key}]"), at, table, known)).transpose()
    }

    /// Tables of a list, each with no other than the known keys.
    pub(crate) fn tables(&self, key: &str, known: &[&str]) -> Result<Vec<Self>, Failure> {
        let place = format!("[[{key}]]");
        let entry = |value: &'d Value<'d>| {
            let at = value.span().start;
            let table = value.get_ref().as_table();
            let table =
                table.ok_or_else(|| self.refused(at, &format!("`{key}` has to be tables, {place}")))?;
            Self::of(self.page, &place, at, table, known)
        };
        self.list(key)?.unwrap_or_default().into_iter().map(entry).collect()
    }

    /// Text of a value as written in the file; strings get the same kind of quotes.
    pub(crate) fn written(&self, value: &Value<'_>) -> String {
        match value.get_ref().as_str().map(|text| format!("\"{text}\"")) {
            // Strings that need escapes stay as written.
            Some(quoted) if !quoted[1..quoted.len() - 1].contains(['"', '\\', '\n', '\r']) => quoted,
            _ => self.page.text.get(value.span()).unwrap_or_default().to_owned(),
        }
    }

    fn typed<T>(
        &self,
        key: &str,
        wanted: &str,
        read: impl FnOnce(&'d DeValue<'d>) -> Option<T>,
    ) -> Result<Option<T>, Failure> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let refused = || {
            let rule = format!("`{key}` has to be {wanted}, is {}", self.written(value));
            self.refused(value.span().start, &rule)
        };
        read(value.get_ref()).map(Some).ok_or_else(refused)
    }
}

/// A number with or without a point.
pub(crate) fn number(value: &DeValue<'_>) -> Option<f64> {
    let text = match value {
        DeValue::Float(float) => float.as_str(),
        DeValue::Integer(whole) if whole.radix() == 10 => whole.as_str(),
        _ => return None,
    };
    text.parse::<f64>().ok().filter(|number| number.is_finite())
}

fn whole(value: &DeValue<'_>) -> Option<u64> {
    value.as_integer().filter(|whole| whole.radix() == 10)?.as_str().parse().ok()
}

/// Sentence about an unknown key, with the known key of the most similar spelling.
fn unknown_key(found: &str, known: &[&str]) -> String {
    format!("unknown key `{found}`{}", nearest(found, known))
}

/// Words appended to a sentence about an unknown word: the known word of similar spelling, or all.
pub(crate) fn nearest(found: &str, known: &[&str]) -> String {
    const LEAST_LIKENESS: f64 = 0.6; // as for a scene's keys: one wrong or missing letter in three
    let alike = known.iter().map(|word| (strsim::jaro_winkler(found, word), *word));
    let best = alike.filter(|(likeness, _)| *likeness >= LEAST_LIKENESS).max_by(|a, b| a.0.total_cmp(&b.0));
    match best {
        Some((_, word)) => format!("; the nearest is `{word}`"),
        None => format!("; there are {}", known.join(", ")),
    }
}
