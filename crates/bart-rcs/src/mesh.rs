//! Topology of a mesh: connected and coplanar parts, edges.

pub(crate) mod welding; // points that are one place
pub(crate) mod mesh_edges; // triangles that meet at an edge
pub(crate) mod neighbours; // the one triangle across a side
pub(crate) mod t_junction; // sides cut at their neighbours' corners
pub(crate) mod curve_bend; // bends that are steps of one curve
pub(crate) mod patch; // coplanar facets as one patch
pub(crate) mod surface_topology; // facets around a line, and the planes of the surface
pub(crate) mod wedges; // diffracting edges, and the extent of their faces
