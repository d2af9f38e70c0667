//! FMCW echoes of scattering paths on an antenna array
pub mod error;
pub mod multiplexing;
pub mod antenna;
pub mod reference;
mod lanes;
pub mod direct_sum;
pub mod window;
pub mod snr_reference;
pub mod noise;
mod admission;
mod synthesis_error;
mod synthesize;

pub use error::EchoError;
pub use synthesize::{Progress, memory_estimate_bytes, synthesize};
