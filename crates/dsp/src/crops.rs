//! Pictures and numbers for a classifier.

pub mod cell_owners; // which object a cell belongs to
pub mod crop; // the map around an object, beamformed to it
pub mod signature; // its visible cells as cross sections
pub mod grayscale; // the whole map
