//! Objects, those at rest, and those that are followed.

#[path = "../common/mod.rs"]
mod common; // radars and cubes
mod objects;
mod stationary;
mod tracks;
