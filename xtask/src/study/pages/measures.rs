//! Measurements that tests of the crates make, taken from beside these tests as they are: few cases are
//! asserted there, many are tabulated here.

#[path = "../../../../crates/wayside/tests/reference_gates/gates/mod.rs"]
pub(super) mod gates;

/// Made-up radars and targets.
pub(in crate::study) mod signals;
/// BART beside dense sampling and rays.
pub(super) mod references;
