//! Edges of bodies: open edges and wedges, and the extent of their faces.

pub(crate) mod wedge; // two faces at an edge
pub(crate) mod body_edges; // diffracting edges of a mesh
pub(crate) mod face_end; // extent of a face
pub(crate) mod coincident_rims; // rims of double skins
pub(crate) mod edge_band; // bands of frequency in which edges are the same
pub(crate) mod world_edges; // edges of posed bodies
