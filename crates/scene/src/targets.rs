//! `[[target]]` and `[[clutter]]`: what moves, and what stands about.

pub(crate) mod clutter;
pub(crate) mod target;
