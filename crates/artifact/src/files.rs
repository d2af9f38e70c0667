//! Reading and writing of files: bounded, whole, and each artifact in one envelope.

pub(crate) mod codec; // encoding of a record
pub mod inputs; // inputs, which no output may replace
pub mod unchanged; // detection of changed inputs
pub mod bounded; // user files of bounded length
pub(crate) mod place_rule; // rules for the place of an output
pub mod sentence; // messages of bounded length
pub(crate) mod fault; // a file and its fault
pub mod whole_file; // files written whole or not at all
pub mod envelope; // the format of all artifacts
