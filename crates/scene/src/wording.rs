//! Sentences about input: allowed values, found values, suggestions; and the allowed targets of references
//! between files.

pub(crate) mod number;
pub(crate) mod allowed_range;
pub(crate) mod excerpt;
pub(crate) mod similarity;
pub(crate) mod reference;
