//! Question of a study: its file, the designs that it compares, and the situations of the comparison.

pub(crate) mod study_text;
pub(crate) mod fields;
pub(crate) mod axis;
pub(crate) mod axes;
pub(crate) mod document;
pub(crate) mod designs;
pub(crate) mod kinds;
pub(crate) mod situations;
pub(crate) mod acceptance;
