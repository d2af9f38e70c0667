//! Reading and writing of files: bounded, whole, and each artifact in one envelope.

pub(crate) mod codec; // encoding of a record
pub mod inputs; // inputs, which no output may replace
pub mod changed_inputs; // detection of changed inputs
pub mod bounded; // user files of bounded length
pub(crate) mod output_path; // rules for the place of an output
pub mod message; // messages of bounded length
pub(crate) mod fault; // a file and its fault
pub mod atomic_file; // files written whole or not at all
pub mod envelope; // the format of all artifacts
