//! Surface that facets represent: flat, or curved.

pub(crate) mod estimated_normals; // creases, and estimated normals
pub(crate) mod curved_edge; // an edge curved by the normals at its ends
pub(crate) mod bend; // height of the skin over a facet
pub(crate) mod refinement; // subdivision of curved triangles
pub(crate) mod skin_triangles; // triangles that represent a mesh
pub(crate) mod curved_skin; // a mesh's triangles, curved
pub(crate) mod skin; // surface represented by facets
