//! How files are read and written: bounded, whole, and each artifact in one envelope.

pub(crate) mod codec; // bytes of a record
pub mod inputs; // what no output may replace
pub mod bounded; // files of users, of bounded length
pub mod whole_file; // written whole or not at all
pub mod envelope; // the format of all artifacts
