//! Words that are given as arguments, each with what it means.

use crate::failure;
use pyo3::prelude::*;

/// Meaning of one of a few words.
///
/// # Errors
/// Another word; the sentence tells those that are known.
pub(crate) fn meaning<T: Copy>(name: &str, given: &str, known: &[(&str, T)]) -> PyResult<T> {
    let found = known.iter().find(|(word, _)| *word == given).map(|(_, value)| *value);
    let words = || known.iter().map(|(word, _)| *word).collect::<Vec<_>>().join("`, `");
    found.ok_or_else(|| failure::argument_error(name, format!("`{given}`; it can be `{}`", words())))
}
