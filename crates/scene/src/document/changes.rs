//! Changes to a scene's values before it is read, by which a study tries other values than the file's.

use crate::document::diagnostics::{Diagnostics, NOWHERE};
use crate::document::errors::{Place, Rule};
use crate::document::toml_text::{self, DEPTH_LIMIT, TooDeep};
use crate::wording::excerpt::excerpt;
use std::borrow::Cow;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value that replaces the one of a scene file under a key, or is added to it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Change {
    /// Key after those of its tables, separated by points; entries of lists by their numbers from 0:
    /// `target.2.y_m`.
    pub key: String,
    /// Value in TOML.
    pub value: String,
}

/// Applies changes in their order; each takes the position of the value that it replaces, else that of its
/// table, else none. Notes changes for which there is no place.
pub(crate) fn apply<'d>(document: &mut DeTable<'d>, changes: &'d [Change], diagnostics: &Diagnostics<'_>) {
    for change in changes {
        if let Err((byte, obstacle)) = apply_one(document, change) {
            diagnostics.note(byte, Place::Scene, Rule::Change { key: excerpt(&change.key), obstacle });
        }
    }
}

/// Byte of the file, and the reason why the change has no place there.
type Obstacle = (usize, String);

fn apply_one<'d>(document: &mut DeTable<'d>, change: &'d Change) -> Result<(), Obstacle> {
    let value = DeValue::parse(&change.value).map_err(|error| (NOWHERE, error.message().to_owned()))?;
    toml_text::check_value(&value).map_err(|too_deep| (NOWHERE, too_deep.to_string()))?;
    let keys: Vec<&'d str> = change.key.split('.').collect();
    if keys.len() > DEPTH_LIMIT {
        return Err((NOWHERE, TooDeep { byte: 0 }.to_string()));
    }
    put_into_table(document, NOWHERE..NOWHERE, &keys, value.into_inner())
}

fn put_into_table<'d>(
    table: &mut DeTable<'d>,
    at: Range<usize>,
    keys: &[&'d str],
    value: DeValue<'d>,
) -> Result<(), Obstacle> {
    let [key, rest @ ..] = keys else { return Ok(()) };
    if key.is_empty() {
        return Err((at.start, "a key between two points is empty".into()));
    }
    let is_entry = rest.first().is_some_and(|next| next.bytes().all(|byte| byte.is_ascii_digit()));
    if is_entry && !rest[0].is_empty() && table.get(*key).is_none() {
        return Err((at.start, format!("`{key}` is a list that the scene leaves out: change all of it")));
    }
    let none_yet = || Spanned::new(at.clone(), DeValue::Table(DeTable::new()));
    let key = Spanned::new(at.clone(), Cow::Borrowed(*key));
    put(table.entry(key).or_insert_with(none_yet), rest, value)
}

fn put<'d>(place: &mut Spanned<DeValue<'d>>, keys: &[&'d str], value: DeValue<'d>) -> Result<(), Obstacle> {
    let at = place.span();
    match (keys, place.get_mut()) {
        ([], known) => {
            *known = moved(value, &at);
            Ok(())
        }
        (keys, DeValue::Table(table)) => put_into_table(table, at, keys, value),
        ([key, rest @ ..], DeValue::Array(list)) => {
            let count = list.len();
            let entry = key.parse::<usize>().ok().and_then(|number| list.get_mut(number));
            let none = || (at.start, format!("`{key}` is no entry of a list of {count}, counted from 0"));
            put(entry.ok_or_else(none)?, rest, value)
        }
        ([key, ..], _) => Err((at.start, format!("`{key}` is asked of what is neither table nor list"))),
    }
}

/// A value with all of its parts at one position of the file: their own positions refer to another text.
fn moved<'d>(value: DeValue<'d>, at: &Range<usize>) -> DeValue<'d> {
    let part = |part: Spanned<DeValue<'d>>| Spanned::new(at.clone(), moved(part.into_inner(), at));
    match value {
        DeValue::Array(list) => DeValue::Array(list.into_iter().map(part).collect()),
        DeValue::Table(table) => {
            let mut all = DeTable::new();
            for (key, value) in table {
                all.insert(Spanned::new(at.clone(), key.into_inner()), part(value));
            }
            DeValue::Table(all)
        }
        single => single,
    }
}
