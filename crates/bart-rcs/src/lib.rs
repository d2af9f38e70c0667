//! Scattering of vehicles at millimetre waves by bidirectional analytic ray tracing (BART)

mod error;
mod antenna;
mod plane;
mod bvh;
mod world;
mod clip;
mod section;
mod shadow;
mod visibility;
mod brute_force;
mod beam;

pub mod reference;
pub use antenna::Antenna;
pub use beam::{Audit, Beam, BeamTree, OrderAudit, TraceSettings};
pub use error::BartError;
pub use plane::Plane;
pub use world::{FacetGeometry, Models, World};
