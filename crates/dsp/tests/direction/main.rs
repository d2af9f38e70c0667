//! Directions of echoes by arrays of all kinds.

#[path = "../common/mod.rs"]
mod common; // radars and cubes
mod arrays;
mod phase_compensation;
mod code_division;
mod calibration;
mod super_resolution;
mod ghosts;
