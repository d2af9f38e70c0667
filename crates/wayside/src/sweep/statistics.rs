//! How sure a mean is, and which designs are worse for sure.

pub(crate) mod student;
pub(crate) mod interval;
pub(crate) mod contest;
