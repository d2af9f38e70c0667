//! Commands that a user types, and what goes wrong with them.

#[path = "../common/mod.rs"]
mod common;

mod controls;
mod idle_options;
mod interrupts;
mod refusals;
mod standard_output;
