//! The stages linked: turns a scene file into its frames, with their paths, cubes, points, tracks and
//! classes, and evaluates them against the ground truth.
//!
//! The stages (`scene`, `bart-rcs`, `fmcw-echo`, `dsp`, `classifier`) meet here; each hands an artifact to
//! the next. The inputs of a frame are hashed, earlier results are read from a cache, and the remaining work
//! is predicted before it begins. Pictures, reports, studies and commands build on this crate and are not
//! part of it.
//!
//! Read the rooms below in their order; each uses only those before it.

pub mod host; // failures, whole files, memory, progress, places
pub mod chain; // what a frame depends on, what is cached, the stages linked
pub mod planning; // what of the physics a scene needs, by its accuracy
pub mod outcome; // summary, verdicts, false objects and tracks
