//! BART compared with dense sampling and rays, as in the tests `bart_against_references` of `wayside`.

#[path = "../../../../../crates/wayside/tests/bart_against_references/continuity.rs"]
pub(crate) mod continuity;
#[path = "../../../../../crates/wayside/tests/bart_against_references/methods.rs"]
pub(crate) mod methods;
#[path = "../../../../../crates/bart-rcs/examples/profile/processor_time.rs"]
mod processor_time;
#[path = "../../../../../crates/wayside/tests/bart_against_references/random_cases.rs"]
pub(crate) mod random_cases;
#[path = "../../../../../crates/wayside/tests/bart_against_references/random_tables.rs"]
pub(crate) mod random_tables;
