//! The stages linked: a scene file goes in, and its frames come out with their paths, cubes, points, tracks
//! and classes, and with what they are worth beside the truth.
//!
//! The stages (`scene`, `bart-rcs`, `fmcw-echo`, `dsp`, `classifier`) meet here; each hands an artifact to
//! the next. What a frame depends on is hashed, what was made of it before is read from a cache, and what is
//! left to do is told before it begins. Pictures, reports, studies and commands stand on this crate and are
//! none of its business.
//!
//! Reading order is that of the rooms below; each uses only those that stand before it.

pub mod host; // failures, whole files, memory, progress, places
pub mod chain; // what a frame depends on, what is cached, the stages linked
pub mod planning; // what of the physics a scene needs, by its accuracy
pub mod outcome; // summary, verdicts, false objects and tracks
