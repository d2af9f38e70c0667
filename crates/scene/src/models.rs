//! Models of bodies: the options of a run, and the models that a scene names.

pub(crate) mod options;
pub(crate) mod nearest_in_size;
pub(crate) mod street_furniture;
pub(crate) mod library;
