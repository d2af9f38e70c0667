//! The radar as an echo meets it: transmissions, and the level that noise is measured against.

pub mod multiplexing; // which transmissions make a row of the cube
pub mod snr_reference; // its peak cell
