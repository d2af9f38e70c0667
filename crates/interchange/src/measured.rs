//! A radar's numbers as a sensor's own axes have them (x ahead, y left, z up), with their standard errors.

pub(crate) mod sensor_axes;
pub(crate) mod box_place;
pub(crate) mod slopes;
pub(crate) mod standard_errors;
pub(crate) mod existence;
