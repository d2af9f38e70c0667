//! A frame of paths becomes a frame of samples.

pub mod phase_noise; // echoes with it, by a few sums without
pub(crate) mod admission; // what is looked at first
pub(crate) mod synthesis_error; // measured in the run
pub(crate) mod synthesizer; // all of it
