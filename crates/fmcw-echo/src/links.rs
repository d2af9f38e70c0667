//! What the radar is to an echo: transmissions, antennas, and the level that noise is measured against.

pub mod multiplexing; // which transmissions make a row of the cube
pub mod antenna; // radar equation, pattern
pub mod snr_reference; // its peak cell
