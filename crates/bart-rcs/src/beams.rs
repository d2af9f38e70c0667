//! Lit polygons and their mirrors.

pub(crate) mod occlusion; // facets as an antenna sees them
pub(crate) mod sheets; // sheets passed by waves
pub(crate) mod visibility; // lit parts of a view
pub(crate) mod brute_force; // the same by testing all pairs
pub(crate) mod body_sequences; // requested sequences of bodies
pub(crate) mod beam; // trees of lit polygons and their mirrors
pub(crate) mod outside; // trees of antennas outside bodies
pub(crate) mod sampled_tree; // sampled beams with weights
pub(crate) mod image_tree; // beams of the antenna's image below a road
