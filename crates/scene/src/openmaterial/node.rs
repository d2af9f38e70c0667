//! A value of a JSON file with its place.

use crate::openmaterial::error::{OpenMaterialError, OpenMaterialFault};
use crate::wording::excerpt::excerpt;
use crate::wording::reference::{ReferenceFault, file_of};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A value with its place.
#[derive(Clone)]
pub(super) struct Node<'d> {
    file: &'d Path,
    place: String,
    value: &'d Value,
}

impl<'d> Node<'d> {
    /// The root of a file.
    pub(super) fn root(file: &'d Path, value: &'d Value) -> Self {
        Self { file, place: String::new(), value }
    }

    /// An error at this place.
    pub(super) fn error(&self, fault: OpenMaterialFault) -> OpenMaterialError {
        OpenMaterialError { file: self.file.to_owned(), place: self.place.clone(), fault }
    }

    /// The value under a key; `None` if it is missing or `null`.
    pub(super) fn find(&self, key: &str) -> Result<Option<Node<'d>>, OpenMaterialError> {
        let Some(object) = self.value.as_object() else { return Err(self.expected("an object")) };
        let place = if self.place.is_empty() { key.to_owned() } else { format!("{}.{key}", self.place) };
        let value = object.get(key).filter(|value| !value.is_null());
        Ok(value.map(|value| Node { file: self.file, place, value }))
    }

    /// The value under a required key.
    pub(super) fn need(&self, key: &'static str) -> Result<Node<'d>, OpenMaterialError> {
        self.find(key)?.ok_or_else(|| self.error(OpenMaterialFault::Missing(key)))
    }

    /// The values of a list.
    pub(super) fn list(
        &self,
    ) -> Result<impl ExactSizeIterator<Item = Node<'d>> + use<'d>, OpenMaterialError> {
        let list = self.value.as_array().ok_or_else(|| self.expected("a list"))?;
        let (file, place) = (self.file, self.place.clone());
        let at = move |(i, value)| Node { file, place: format!("{place}[{i}]"), value };
        Ok(list.iter().enumerate().map(at))
    }

    /// The values of a list of length `N`.
    pub(super) fn tuple<const N: usize>(
        &self,
        expected: &'static str,
    ) -> Result<[Node<'d>; N], OpenMaterialError> {
        let values: Vec<Node<'d>> = self.list()?.take(N + 1).collect();
        values.try_into().map_err(|_| self.expected(expected))
    }

    pub(super) fn text(&self) -> Result<&'d str, OpenMaterialError> {
        self.value.as_str().ok_or_else(|| self.expected("a text"))
    }

    pub(super) fn number(&self) -> Result<f64, OpenMaterialError> {
        self.value.as_f64().ok_or_else(|| self.expected("a number"))
    }

    /// A number; `None` for `null`.
    pub(super) fn number_or_null(&self) -> Result<Option<f64>, OpenMaterialError> {
        if self.value.is_null() { Ok(None) } else { self.number().map(Some) }
    }

    /// The file that the text names, with the given ending.
    pub(super) fn reference(&self, ending: &'static str) -> Result<PathBuf, OpenMaterialError> {
        let found = self.text()?;
        let said = || excerpt(found);
        if !found.ends_with(ending) {
            return Err(self.error(OpenMaterialFault::Ending { found: said(), ending }));
        }
        file_of(found, self.file).map_err(|fault| {
            self.error(match fault {
                ReferenceFault::Malformed => OpenMaterialFault::Malformed(said()),
                ReferenceFault::Outside => OpenMaterialFault::Outside(said()),
            })
        })
    }

    fn expected(&self, expected: &'static str) -> OpenMaterialError {
        self.error(OpenMaterialFault::Expected { expected, found: kind(self.value) })
    }
}

/// Kind of a value, for a sentence.
fn kind(value: &Value) -> String {
    match value {
        Value::Null => "null".to_owned(),
        Value::Bool(truth) => truth.to_string(),
        Value::Number(number) => number.to_string(),
        Value::String(text) => format!("the text `{}`", excerpt(text)),
        Value::Array(list) => format!("a list of {} values", list.len()),
        Value::Object(_) => "an object".to_owned(),
    }
}
