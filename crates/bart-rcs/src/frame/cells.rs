//! Lit polygons and edges as cells with one node each.

pub(crate) mod cell_memory; // how many cells memory has room for
pub(crate) mod corner_slide; // corners that slide over their body
pub(crate) mod path_cells; // of lit polygons
pub(crate) mod edge_cells; // of lit edges
pub(crate) mod critical_cells; // of corners and sides of large polygons, off their specular
pub(crate) mod grid_nodes; // of their parts about the stationary point
pub(crate) mod small_part_paths; // of small parts that meshes lack
pub(crate) mod point_paths; // of point targets
