//! `[[target]]` and `[[clutter]]`: moving bodies and clutter.

pub(crate) mod clutter;
pub(crate) mod target;
