//! Directions and places, found from the channels of a cell.

pub mod angle; // the virtual array and its beams
pub(crate) mod directional_peaks; // echoes beside stronger ones, seen in other beams
pub(crate) mod point_sources; // several echoes of one cell
pub(crate) mod multipath_ghost; // directions of departure and of arrival that differ
pub(crate) mod position; // world axes
pub(crate) mod calibration; // channel errors from a reflector
