//! Features of a signature for classification.

pub(crate) mod profile; // its visible cells
pub(crate) mod feature; // names and numbers
pub(crate) mod bands; // heights and widths along it
pub(crate) mod peaks; // its strongest cells
pub(crate) mod features; // all of them
pub(crate) mod cells; // inputs of networks over its range cells
