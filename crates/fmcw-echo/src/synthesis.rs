//! Synthesis of a frame of samples from a frame of paths.

pub mod phase_noise; // phase noise from a few sums without it
pub(crate) mod input_checks; // checks before synthesis
pub(crate) mod synthesis_error; // error measured in the run
pub(crate) mod synthesizer; // the complete stage
