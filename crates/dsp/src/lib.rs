//! From radar cubes to range-Doppler maps, detections, point clouds, objects and crops.
mod error;
pub mod axes;
pub mod window;
pub mod range_doppler;
pub mod doppler_division;
pub mod noncoherent;
pub mod cfar_threshold;
pub mod cfar;
pub mod interpolation;
pub mod peaks;
pub mod angle;
pub mod position;
pub mod clusters;
pub mod points;
pub mod crop;
pub mod grayscale;

pub use axes::{range_axis_m, velocity_axis_mps};
pub use crop::{PAPER_CROP, crop};
pub use error::{Axis, DspError};
pub use grayscale::rdm_grayscale;
pub use noncoherent::{noise_power, power_map};
pub use points::detect;
pub use range_doppler::range_doppler;
