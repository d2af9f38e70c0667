//! Transmissions of a radar, and the reference level for noise.

pub mod multiplexing; // transmissions that make a row of the cube
pub mod snr_reference; // peak cell of the noise-free map
