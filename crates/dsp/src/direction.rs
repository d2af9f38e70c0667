//! From the channels of a cell to directions and places.

pub mod angle; // the virtual array and its beams
pub mod directional_peaks; // echoes beside stronger ones, seen in other beams
pub mod point_sources; // several echoes of one cell
pub mod two_ways; // waves that came back by another way
pub mod position; // world axes
pub mod calibration; // channel errors from a reflector
