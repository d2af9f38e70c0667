//! Tests of what maps hold, of samples good and bad.

#[path = "../common/mod.rs"]
mod common; // radars and cubes
mod point_targets;
mod statistics;
mod schedules;
mod robustness;
