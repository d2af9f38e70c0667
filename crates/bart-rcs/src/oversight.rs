//! Limits and listeners of a run: what it refuses, the memory that it may take, and who hears how far
//! it is and who ends it.

pub(crate) mod error; // what can be wrong with a body or an antenna
pub(crate) mod called_off; // by whoever asked for the work
pub(crate) mod memory; // expected, watched, refused
pub(crate) mod progress; // who hears how far work is
pub(crate) mod work_meter; // whose work the processors' time was
