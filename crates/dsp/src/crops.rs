//! Images and features for a classifier.

pub(crate) mod cell_owners; // object to which a cell belongs
pub(crate) mod crop; // map around an object, beamformed to it
pub(crate) mod signature; // range cells of an object as cross sections
pub(crate) mod grayscale; // the whole map
