//! Scattering of vehicles at millimetre waves by bidirectional analytic ray tracing (BART; Xu and Jin, IEEE
//! T-AP 57 (2009) 1495).
//!
//! Input is a mesh, output the scattering amplitude S in metres ([`rcs`]); |S|² is the radar cross section in
//! m². Alternatively a scene's frame yields its scattering paths ([`Tracer::paths`]), from which echoes are
//! made. Signs, axes and units: `docs/conventions.md`; formulas: `docs/physics.md`.
//!
//! ```
//! use artifact::scene::Mesh;
//! use bart_rcs::{RcsRequest, rcs};
//! // A square of 0.3 m seen square at 77 GHz: σ = 4πA²/λ², 38.27 dBsm.
//! let plate = Mesh {
//!     vertices_m: vec![[0.0, -0.15, -0.15], [0.0, 0.15, -0.15], [0.0, 0.15, 0.15], [0.0, -0.15, 0.15]],
//!     triangles: vec![[0, 1, 2], [0, 2, 3]],
//!     ..Mesh::default()
//! };
//! // Far away and from ahead, all else as `wayside rcs` has it.
//! let ahead = RcsRequest::over(vec![77e9], vec![0.0], vec![0.0]);
//! let amplitude_m = rcs(&plate, &ahead, &|_, _| {})?.amplitude_m[0];
//! assert!((10.0 * amplitude_m.norm_sqr().log10() - 38.2703).abs() < 1e-3);
//! # Ok::<(), bart_rcs::BartError>(())
//! ```
//!
//! Method and reading order: a [`World`] holds every facet of every body at one instant. From an [`Antenna`]
//! a [`BeamTree`] grows: each facet is clipped exactly against those that hide it, and each lit polygon is a
//! mirror for the next order. No rays are sampled; the lit part is the silhouette to rounding. The tree is
//! independent of frequency and polarization. If a beam from the transmitter and one from the receiver end on
//! the same facet, they are joined, and physical optics is integrated over the common polygon in closed form.
//! The crate `po-sbr` has slow, obvious reference methods that share none of this.

mod run_control; // errors, memory limits, progress
mod geometry; // points, planes, polygons
mod mesh; // topology and edges of a mesh
mod materials; // reflection and transmission
mod surface; // surface that facets stand for: flat, or curved
mod bodies; // posed meshes, and the road below them
mod beams; // lit polygons and their mirrors
mod integral; // integration over a lit polygon, in closed form
mod joins; // joins of beams from both ends
mod edges; // contributions of edges to physical optics
mod table; // S at aspects, over frequency
mod frame; // paths of a frame, or its table
mod detail; // fewer paths for the same echo; the stage that makes them from a scene's frames

pub use beams::beam::{Audit, Beam, BeamTree, OrderAudit, TraceSettings};
pub use bodies::road::usual_road;
pub use bodies::world::World;
pub use detail::level::reduce_detail;
pub use detail::tracer::Tracer;
pub use frame::expected_work::ExpectedWork;
pub use frame::left_out::echo_parts::{EchoParts, ORDERS as ORDERS_OF_PARTS, RoadParts};
pub use frame::path::FrameContext;
pub use frame::path_plan::{MOMENTS_MAX, paths_are_at_limit};
pub use frame::path_sum::{PathView, scattering_of_paths};
pub use frame::path_table::{element_offset_m, largest_cell_m};
pub use geometry::antenna::Antenna;
pub use geometry::facet_geometry::FacetGeometry;
pub use geometry::plane::Plane;
pub use radar::standpoint::Standpoint;
pub use run_control::cancellation::CancellationCheck;
pub use run_control::error::BartError;
pub use run_control::memory::{MemoryLimit, memory_estimate_bytes};
pub use run_control::progress::{NoProgress, Phase, Progress};
pub use surface::skin::{Role, Skin};
pub use table::antennas::check_antennas;
pub use table::checkpoint::{CheckpointKey, CheckpointStore, NoCheckpoint};
pub use table::contributions::{Contribution, contributions};
pub use table::far_field_error::{FarFieldError, Spread};
pub use table::rcs_request::RcsRequest;
pub use table::rcs_table::{MirrorRefinement, RcsContext, RcsResult, RcsSeconds, rcs, rcs_within};
