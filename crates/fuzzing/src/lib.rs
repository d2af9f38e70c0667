//! Structure-aware fuzzing of what reads files: no case panics, takes a minute or gibibytes, and what is
//! refused is refused with a sentence that names the file. Tests of other crates use it and no product does;
//! it sees no crate of the workspace.
//!
//! A test lists its readers, each with how a case is made and how it is read, and calls [`fuzz`]. Cases are
//! functions of a seed and a number, so one that fails is made again by these.
//!
//! ```text
//! WAYSIDE_FUZZ_CASES=100000   cases for each reader (as many as the reader says)
//! WAYSIDE_FUZZ_MINUTES=30     as many processor minutes for each reader instead, in turn
//! WAYSIDE_FUZZ_SEED=2         other cases (1)
//! WAYSIDE_FUZZ_READER=fcd     one reader
//! WAYSIDE_FUZZ_FIRST=100      cases from this number on (0)
//! WAYSIDE_FUZZ_CASE=3297      this case alone; its files stay, whether it passes or not
//! WAYSIDE_FUZZ_LOG=FILE       appends a line for each minute of each reader: docs/validation/fuzz.md
//! ```
//!
//! A case that fails stays in the folder that is told.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a helper of tests fails the test")]

mod rng; // deterministic randomness, and numbers at which readers stumble
mod tokens; // texts, changed by their words and lines
mod values; // JSON values, changed by their structure
mod binary_words; // numbers within bytes
mod watchdog; // over time and memory
mod log; // of what was tried
mod trial; // the loop over readers

pub use binary_words::mutate_word32;
pub use rng::FuzzRng;
pub use tokens::{mutate as mutate_text, with_toml_punctuation};
pub use trial::{Reader, fuzz};
pub use values::{
    insert_nonfinite_floats, mutate as mutate_json, mutate_keeping_types as mutate_json_keeping_types,
};
