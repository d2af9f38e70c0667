//! Tests of what a classifier sees of a map.

#[path = "../common/mod.rs"]
mod common; // radars and cubes
mod crops;
mod signatures;
