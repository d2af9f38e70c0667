//! Measurements of the crates' tests, included from the tests' folders unchanged: few cases are asserted
//! there, many are tabulated here.

#[path = "../../../../crates/wayside/tests/reference_gates/gates/mod.rs"]
pub(super) mod gates;

/// Synthetic radars and targets.
pub(in crate::study) mod signals;
/// BART compared with dense sampling and rays.
pub(super) mod references;
