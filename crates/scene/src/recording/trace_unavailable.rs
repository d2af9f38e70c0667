//! Traces of OSI in a program built without their reader: they are refused, and the error describes how to
//! build one with it.

use crate::recording::fcd::{FcdError, FcdRule, FcdStep, RecordingPlace};
use artifact::bounded;
use std::path::Path;

/// A reader; this program has none.
pub(crate) enum TraceReader {}

impl TraceReader {
    pub(crate) fn open(file: &Path) -> Result<Self, FcdError> {
        let rule = bounded::open(file).map_or_else(FcdRule::Unreadable, |_| FcdRule::WithoutInterchange);
        Err(FcdError { file: file.to_owned(), place: RecordingPlace::File, rule: Box::new(rule) })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trace_that_is_not_there_is_the_systems_fault_and_one_that_is_there_the_programs() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.osi");
        let told = |words: &str| format!("{}: {words}", file.display());
        let absent = TraceReader::open(&file).err().unwrap();
        assert!(absent.is_system(), "{absent}");
        assert!(absent.to_string().starts_with(&told("cannot be read: ")), "{absent}");
        std::fs::write(&file, "").unwrap();
        let unread = TraceReader::open(&file).err().unwrap();
        assert!(!unread.is_system(), "{unread}");
        assert!(unread.to_string().starts_with(&told("this program was built without")), "{unread}");
    }
}
