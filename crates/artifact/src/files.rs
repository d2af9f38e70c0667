//! Reading and writing of files: bounded, whole, and each artifact in one envelope.

pub(crate) mod codec; // bytes of a record
pub mod inputs; // what no output may replace
pub mod unchanged; // inputs that work began with
pub mod bounded; // files of users, of bounded length
pub(crate) mod place_rule; // where no file may be put
pub mod sentence; // about a file, short enough for a reader
pub(crate) mod fault; // a file, and what is wrong with it
pub mod whole_file; // written whole or not at all
pub mod envelope; // the format of all artifacts
