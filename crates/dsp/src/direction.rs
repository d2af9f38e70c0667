//! Directions and positions from the channels of a cell.

pub mod angle; // the virtual array and its beams
pub(crate) mod directional_peaks; // echoes beside stronger ones, in other beams
pub(crate) mod point_sources; // several echoes of one cell
pub(crate) mod multipath_ghost; // different directions of departure and arrival
pub(crate) mod position; // positions in world axes
pub(crate) mod calibration; // channel errors from a reflector
