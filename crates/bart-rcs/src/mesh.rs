//! What belongs together in a mesh.

pub(crate) mod patch; // coplanar facets that are one flat
pub(crate) mod welding; // vertices of one place
pub(crate) mod weld; // corners that are one point
pub(crate) mod mesh_edges; // and the triangles at each edge
pub(crate) mod surface_topology; // triangles by shared lines, and flat patches
