//! What a user types, and what goes wrong with it.

#[path = "../common/mod.rs"]
mod common;

mod refusals;
mod standard_output;
