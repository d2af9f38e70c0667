//! Surface that facets stand for: themselves, or a curved one.

pub(crate) mod made_normals; // creases, and normals where a mesh stores none
pub(crate) mod curved_edge; // an edge bent by the normals at its ends
pub(crate) mod bend; // the skin's height over a facet
pub(crate) mod refinement; // bent triangles cut until they are flat
pub(crate) mod skin_triangles; // the triangles that stand for a mesh
pub(crate) mod curved_skin; // a mesh's triangles, bent
pub(crate) mod skin; // what facets stand for
