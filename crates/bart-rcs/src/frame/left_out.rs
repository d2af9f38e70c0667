//! Error of ways that are not traced: what they would add to a frame.

pub(crate) mod ways; // some ways added up beside what was traced
pub(crate) mod road; // those by a road
pub(crate) mod between_bodies; // those between bodies
pub(crate) mod echo_parts; // all of them at once, coarsely: what a plan of the physics stands on
