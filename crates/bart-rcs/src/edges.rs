//! Scattering of edges, beyond physical optics.

pub(crate) mod fringe; // currents of a wedge beyond physical optics
pub(crate) mod line_integral; // of a weight under a fast phase
pub(crate) mod lit_edge; // which parts of edges both ends light
pub(crate) mod fresnel; // the Fresnel integral of an edge wave
pub(crate) mod end_current; // what is not there beyond the end of a face
pub(crate) mod edge_on; // antennas in the plane of a sheet
pub(crate) mod edge_node; // a part of an edge with its legs
pub(crate) mod face_waves; // waves over faces, from edge to edge
pub(crate) mod edge_currents; // the fringe integral along an edge
pub(crate) mod mirror_window; // the field behind a mirror of finite size
pub(crate) mod truncation; // ends of a double reflection at own edges
pub(crate) mod parted_sequences; // which double reflections have them
pub(crate) mod edge_scattering; // S of all edges
