//! Scattering by edges, beyond physical optics.

pub(crate) mod fringe; // currents of a wedge beyond physical optics
pub(crate) mod wave_exit; // where a wave over faces leaves them
pub(crate) mod line_integral; // integrals of a weight with a fast phase
pub(crate) mod lit_edge; // parts of edges lit from both ends
pub(crate) mod fresnel; // Fresnel integral of an edge wave
pub(crate) mod end_current; // current beyond the end of a face
pub(crate) mod edge_on; // antennas in the plane of a sheet
pub(crate) mod fields_over_surfaces; // fields over materials on the way to an edge
pub(crate) mod edge_node; // a part of an edge with its legs
pub(crate) mod face_waves; // waves over faces, from edge to edge
pub(crate) mod edge_currents; // the fringe integral along an edge
pub(crate) mod mirror_window; // field behind a mirror of finite size
pub(crate) mod truncation; // truncation of a double reflection at own edges
pub(crate) mod off_specular_sequences; // double reflections with truncation
pub(crate) mod edge_scattering; // S of all edges
