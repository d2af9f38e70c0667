//! Checks against reference data, each as rows of figure beside gate: for the tests beside, and for the page
//! of `cargo xtask study reference-gates`.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "reference data that cannot be read ends the test or the study"
)]
#![allow(dead_code, reason = "each uses its own part")]

mod table;
mod bodies;
mod method;
mod row;
pub(crate) mod closed_form;
pub(crate) mod austin;
pub(crate) mod corners;
pub(crate) mod full_wave;
pub(crate) mod edges;

pub(crate) use row::Row;

/// Check that makes the rows of a table from the folder of reference data.
pub(crate) type Check = fn(&std::path::Path) -> Vec<Row>;

/// Every check, in the page's order, under its heading.
pub(crate) const CHECKS: [(&str, Check); 5] = [
    ("First order against closed forms", closed_form::rows),
    ("First order against the Austin suite", austin::rows),
    ("Multiple bounces against closed forms", corners::rows),
    ("Edges against exact, measured and full-wave solutions", edges::rows),
    ("Multiple bounces against full wave and the duct box", full_wave::rows),
];
