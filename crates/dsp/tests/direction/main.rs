//! Directions of echoes by arrays of all kinds.

#[path = "../common/mod.rs"]
mod common; // radars and cubes
mod arrays;
mod phase_compensation;
mod code_division;
mod erring_elements;
mod calibration;
mod pair_trials;
mod super_resolution;
mod ghost_cells;
mod ghosts;
