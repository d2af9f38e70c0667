//! Studies whose rows stand in a part of a page between prose: what tests of the crates assert of few cases,
//! measured of many.

pub(super) mod deployment;
pub(super) mod kept;
pub(super) mod measures;
mod part;
pub(super) mod planner;
pub(super) mod real_captures;
pub(super) mod same_bytes;
mod scattering;
pub(super) mod sensitivity;
mod signals;

pub(super) use part::Part;
pub(super) use scattering::{continuity, estimates_of_errors, gates, published_levels, references, wheels};
pub(super) use signals::{
    ambiguity, calibration, estimates, false_alarms, ghosts, super_resolution, traced_ghosts,
    transmitters_in_turn,
};
