//! Sentences about input: allowed values, found values, suggestions; and the allowed targets of references
//! between files.

pub(crate) mod number;
pub(crate) mod allowed;
pub(crate) mod excerpt;
pub(crate) mod likeness;
pub(crate) mod reference;
