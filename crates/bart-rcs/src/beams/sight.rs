//! Facets as an antenna sees them: where they appear, what they hide, and what their shadows are tested by.

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
