//! What Python gives, as the library takes it.

pub(crate) mod numbers; // within their ranges
pub(crate) mod words; // of a few
pub(crate) mod document; // a scene as a path or a dictionary
