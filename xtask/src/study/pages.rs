//! Studies whose rows stand in a part of a page between prose: what tests of the crates assert of few cases,
//! measured of many.

pub(super) mod deployment;
pub(super) mod force;
pub(super) mod kept;
pub(super) mod measures;
mod part;
pub(super) mod planner;
pub(super) mod real_captures;
pub(super) mod same_bytes;
pub(super) mod scattering;
pub(super) mod sensitivity;
pub(super) mod signals;

pub(super) use part::Part;
