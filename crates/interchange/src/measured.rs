//! A radar's measurements in a sensor's own axes (x ahead, y left, z up), with their standard errors.

pub(crate) mod sensor_axes;
pub(crate) mod box_covariance;
pub(crate) mod main_lobe;
pub(crate) mod standard_errors;
pub(crate) mod existence;
pub(crate) mod frame_names;
pub(crate) mod packed_points;
