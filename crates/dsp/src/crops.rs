//! Pictures and numbers for a classifier.

pub(crate) mod cell_owners; // which object a cell belongs to
pub(crate) mod crop; // the map around an object, beamformed to it
pub(crate) mod signature; // its visible cells as cross sections
pub(crate) mod grayscale; // the whole map
