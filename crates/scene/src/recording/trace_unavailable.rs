//! Traces of OSI in a program built without their reader: they are refused, and the error describes how to
//! build one with it.

use crate::recording::fcd::{FcdError, FcdRule, FcdStep, RecordingPlace};
use std::path::Path;

/// A reader; this program has none.
pub(crate) enum TraceReader {}

impl TraceReader {
    pub(crate) fn open(file: &Path) -> Result<Self, FcdError> {
        let (place, rule) = (RecordingPlace::Message(1), Box::new(FcdRule::WithoutInterchange));
        Err(FcdError { file: file.to_owned(), place, rule })
    }

    pub(crate) fn next_step(&mut self) -> Result<Option<FcdStep>, FcdError> {
        match *self {}
    }

    pub(crate) fn size_m(&self, _id: &str) -> Option<[f64; 3]> {
        match *self {}
    }

    pub(crate) fn error_at(&self, _message: u64, _rule: FcdRule) -> FcdError {
        match *self {}
    }
}

/// Names of types: none.
pub(crate) fn type_names() -> impl Iterator<Item = &'static str> {
    std::iter::empty()
}

/// Accepts any name unchanged, because no trace is read.
pub(crate) fn canonical_type_name(name: &str) -> Option<String> {
    Some(name.to_owned())
}
