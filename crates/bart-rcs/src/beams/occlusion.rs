//! Facets as seen by an antenna: their projections, what they hide, and the tests of their shadows.

pub(crate) mod depth_order; // depth order of two facets, decided once
pub(crate) mod material_order; // depth order of two materials in one place
pub(crate) mod view; // viewpoint and opening
pub(crate) mod shadow; // part hidden by one facet
pub(crate) mod window; // part of a facet inside the view
pub(crate) mod lit_parts; // lit polygons of a view
pub(crate) mod projection; // projection of facets across a view
pub(crate) mod outline; // cells of the view touched by a facet
pub(crate) mod solid_cells; // cells filled by connected facets
pub(crate) mod projected_triangle; // test of separation
pub(crate) mod projection_grid; // candidate occluders in a direct view
