//! Sources of recorded traffic, and their steps in order.

use crate::recording::fcd::{FcdError, FcdReader, FcdRule, FcdStep};
use crate::recording::trace::{TraceReader, canonical_type_name};
use std::path::PathBuf;

/// The recording that a scene names.
pub(crate) enum Source {
    /// Floating-car data of SUMO.
    Fcd(PathBuf),
    /// A trace of OSI's ground truth.
    Osi(PathBuf),
}

impl Source {
    /// The recording's name for a type; `None` if it has no such type. SUMO's types have any names.
    pub(crate) fn canonical_type_name(&self, name: &str) -> Option<String> {
        match self {
            Self::Fcd(_) => Some(name.to_owned()),
            Self::Osi(_) => canonical_type_name(name),
        }
    }

    /// Opens the recording.
    pub(crate) fn open(&self) -> Result<StepReader, FcdError> {
        match self {
            Self::Fcd(file) => FcdReader::open(file).map(|reader| StepReader::Fcd(Box::new(reader))),
            Self::Osi(file) => TraceReader::open(file).map(StepReader::Osi),
        }
    }
}

/// Reader of an open recording.
pub(crate) enum StepReader {
    Fcd(Box<FcdReader>),
    Osi(TraceReader),
}

impl StepReader {
    /// The next step; `None` after the last.
    pub(crate) fn next_step(&mut self) -> Result<Option<FcdStep>, FcdError> {
        match self {
            Self::Fcd(reader) => reader.next_step(),
            Self::Osi(reader) => reader.next_step(),
        }
    }

    /// An error of the recording at a line or message.
    pub(crate) fn error_at(&self, line: u64, rule: FcdRule) -> FcdError {
        match self {
            Self::Fcd(reader) => reader.error_at(line, rule),
            Self::Osi(reader) => reader.error_at(line, rule),
        }
    }

    /// The error of a recording without steps.
    pub(crate) fn without_steps(&self) -> FcdError {
        match self {
            Self::Fcd(_) => self.error_at(1, FcdRule::NoSteps),
            Self::Osi(_) => self.error_at(1, FcdRule::NoMessages),
        }
    }

    /// Length, width and height of a vehicle of the last step, if recorded.
    pub(crate) fn size_m(&self, id: &str) -> Option<[f64; 3]> {
        match self {
            Self::Fcd(_) => None,
            Self::Osi(reader) => reader.size_m(id),
        }
    }
}

#[cfg(test)]
mod tests {
    #[cfg(feature = "interchange")]
    #[test]
    fn a_trace_without_a_message_is_refused_in_words_of_its_own() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("empty.osi");
        std::fs::write(&file, "").unwrap();
        let mut reader = super::Source::Osi(file).open().unwrap();
        assert!(reader.next_step().unwrap().is_none());
        let told = reader.without_steps().to_string();
        let rule = "message 1: there is none: a trace of OSI has a GroundTruth for each step, or a SensorView with \
                    one in it";
        assert!(told.ends_with(&format!("empty.osi: {rule}")), "{told}");
    }
}
