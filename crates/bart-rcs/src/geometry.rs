//! Points, planes, polygons.

pub(crate) mod plane; // planes of facets
pub(crate) mod antenna; // a point or a direction, and its images
pub(crate) mod antenna_plane; // planes through an antenna
pub(crate) mod facet_geometry; // a triangle with its plane
pub(crate) mod border; // end of a lit polygon
pub(crate) mod clip; // a convex polygon cut by a plane
pub(crate) mod section; // solid angle, or area across a direction
pub(crate) mod plane_frame; // coordinates in a facet's plane
pub(crate) mod convex_intersection; // overlap of two beams
pub(crate) mod sweep; // test of boxes against a beam
pub(crate) mod bvh; // obvhs proposes candidates in single precision
pub(crate) mod nearest_point; // nearest points of polygons and their sides
