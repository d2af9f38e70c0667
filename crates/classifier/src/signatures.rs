//! Features of a signature, which tell the class.

pub(crate) mod profile; // its visible cells
pub(crate) mod feature; // names and numbers
pub(crate) mod bands; // heights and widths along it
pub(crate) mod peaks; // its strongest places
pub(crate) mod features; // all of them
