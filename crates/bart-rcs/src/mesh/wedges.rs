//! Edges of bodies: open edges and wedges, and how far their faces go.

pub(crate) mod wedge; // two faces at an edge
pub(crate) mod body_edges; // which edges of a mesh diffract
pub(crate) mod face_end; // how far a face goes
pub(crate) mod side_by_side; // rims of double skins
pub(crate) mod world_edges; // edges of posed bodies
