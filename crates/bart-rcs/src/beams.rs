//! Lit polygons and their mirrors.

pub(crate) mod sight; // facets as an antenna sees them
pub(crate) mod sheets; // what waves have passed
pub(crate) mod visibility; // what a view shows
pub(crate) mod brute_force; // the same by trying all pairs
pub(crate) mod body_ways; // which ways are asked for
pub(crate) mod beam; // trees of lit polygons and their mirrors
pub(crate) mod outside; // trees of antennas that stand outside of bodies
pub(crate) mod sampled_tree; // a few beams that stand for all
pub(crate) mod image_tree; // over a road, with those of the antenna's image
