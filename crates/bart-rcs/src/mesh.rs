//! Topology of a mesh: what belongs together in it.

pub(crate) mod welding; // points of one place
pub(crate) mod mesh_edges; // triangles that meet at an edge
pub(crate) mod neighbours; // the one triangle across a side
pub(crate) mod t_junction; // sides cut at their neighbours' corners
pub(crate) mod curve_bend; // bends that are steps of one curve
pub(crate) mod patch; // coplanar facets that are one flat
pub(crate) mod surface_topology; // facets about a line, and the planes of the surface
pub(crate) mod wedges; // where edges diffract, and how far their faces go
