//! Sentences about what was read: what is allowed, what was found, what may be meant; and where references of
//! files may lead.

pub(crate) mod number;
pub(crate) mod allowed;
pub(crate) mod excerpt;
pub(crate) mod likeness;
pub(crate) mod reference;
