//! Models of bodies: what one run says of them, and those that a scene names.

pub(crate) mod options;
pub(crate) mod nearest_in_size;
pub(crate) mod street_piece;
pub(crate) mod library;
