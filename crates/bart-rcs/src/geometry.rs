//! Points, planes, polygons.

pub(crate) mod plane; // of facets
pub(crate) mod antenna; // a point or a direction, and its images
pub(crate) mod antenna_plane; // planes through an antenna
pub(crate) mod facet_geometry; // a triangle with its plane
pub(crate) mod border; // what ends a lit polygon
pub(crate) mod clip; // a convex polygon cut by a plane
pub(crate) mod section; // solid angle, or area across a direction
pub(crate) mod plane_frame; // coordinates in a facet's plane
pub(crate) mod convex_intersection; // where two beams overlap
pub(crate) mod sweep; // of a beam, as boxes see it
pub(crate) mod bvh; // obvhs proposes candidates in single precision
pub(crate) mod nearest_point; // of polygons and their sides
