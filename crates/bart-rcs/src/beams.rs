//! Lit polygons and their mirrors.

pub(crate) mod depth_order; // which of two facets is in front, decided once
pub(crate) mod view; // from where and through which hole
pub(crate) mod shadow; // what one facet hides
pub(crate) mod window; // what the view leaves of a facet
pub(crate) mod lit_parts; // what it shows
pub(crate) mod prospect; // where facets appear across a view
pub(crate) mod outline; // and which cells of it they touch
pub(crate) mod solid_cells; // what facets that hang together hide of it
pub(crate) mod projected_triangle; // and whether two are apart
pub(crate) mod projection_grid; // what may stand before what in a direct view
pub(crate) mod sheets; // what waves have passed
pub(crate) mod visibility; // what a view shows
pub(crate) mod brute_force; // the same by trying all pairs
pub(crate) mod body_ways; // which ways are asked for
pub(crate) mod beam; // trees of lit polygons and their mirrors
pub(crate) mod outside; // trees of antennas that stand outside of bodies
pub(crate) mod sampled_tree; // a few beams that stand for all
pub(crate) mod image_tree; // over a road, with those of the antenna's image
