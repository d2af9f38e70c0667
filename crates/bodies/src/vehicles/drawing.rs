//! Tools for drawing all vehicles: lines, skins, holes in them, solids, wheels and riders, and the assembly
//! into a mesh.

pub(crate) mod curve;
pub(crate) mod surface;
pub(crate) mod stencil;
pub(crate) mod openings;
pub(crate) mod shell;
pub(crate) mod solids;
pub(crate) mod mesh_builder;
pub(crate) mod wheel;
pub(crate) mod rider;
