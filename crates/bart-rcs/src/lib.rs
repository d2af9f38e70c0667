//! Scattering of vehicles at millimetre waves by bidirectional analytic ray tracing (BART)

mod error;
mod antenna;
mod plane;
mod bvh;
mod world;
mod clip;
mod section;
mod depth_order;
mod view;
mod shadow;
mod visibility;
mod brute_force;
mod beam;
mod divided_difference;
mod polygon_phase;
mod plane_frame;
mod polarization;
mod tiling;
mod physical_optics;
mod convex_intersection;
mod join;
mod scatterer;
mod aspect;
mod rcs_table;
mod path_cells;
mod nearest_surface;
mod path_sum;
mod path_pruning;
mod frame_error;
mod path;
pub mod reference;
#[cfg(test)]
mod test_quadrature;

pub use antenna::Antenna;
pub use beam::{Audit, Beam, BeamTree, OrderAudit, TraceSettings};
pub use error::BartError;
pub use path::trace_frame;
pub use path_sum::{PathView, scattering_of_paths};
pub use plane::Plane;
pub use rcs_table::{RcsRequest, RcsResult, RcsSeconds, Standpoint, rcs};
pub use world::{FacetGeometry, Models, World};
