//! Scattering of vehicles at millimetre waves by bidirectional analytic ray tracing (BART; Xu and Jin, IEEE T-AP 57 (2009)
//! 1495).
//!
//! A mesh goes in, the scattering amplitude S in metres comes out ([`rcs`]); |S|² is the radar cross section in m². Or a
//! scene's frame goes in and its scattering paths come out ([`trace_frame`]), from which echoes are made. Signs, axes and
//! units: `docs/conventions.md`; formulas: `docs/physics.md`.
//!
//! ```
//! use artifact::{Accuracy, radar::Polarization, scene::Mesh, settings::{Edges, NodeRule, Sides, Surface}};
//! use bart_rcs::{RcsRequest, rcs};
//! // A square of 0.3 m seen square at 77 GHz: σ = 4πA²/λ², 38.27 dBsm.
//! let plate = Mesh {
//!     vertices_m: vec![[0.0, -0.15, -0.15], [0.0, 0.15, -0.15], [0.0, 0.15, 0.15], [0.0, -0.15, 0.15]],
//!     triangles: vec![[0, 1, 2], [0, 2, 3]],
//!     ..Mesh::default()
//! };
//! let ahead = RcsRequest {
//!     frequency_hz: vec![77e9],
//!     elevation_rad: vec![0.0],
//!     azimuth_rad: vec![0.0],
//!     range_m: f64::INFINITY,
//!     receiver: None,
//!     polarization: Polarization::Vv,
//!     bounces: 3,
//!     nodes: NodeRule::Middle,
//!     sides: Sides::Two,
//!     edges: Edges::Ignored,
//!     surface: Surface::Flat,
//!     accuracy: Accuracy::from_db(-40.0),
//! };
//! let amplitude_m = rcs(&plate, &ahead, &|_, _| {})?.amplitude_m[0];
//! assert!((10.0 * amplitude_m.norm_sqr().log10() - 38.2703).abs() < 1e-3);
//! # Ok::<(), bart_rcs::BartError>(())
//! ```
//!
//! How it works, and in which order to read: a [`World`] holds every facet of every body at one instant. From an
//! [`Antenna`] a [`BeamTree`] grows: each facet is clipped exactly against those that hide it, and each lit polygon is a
//! mirror for the next order. No ray is sampled; what is lit is the silhouette to rounding. The tree knows no frequency and
//! no polarization. Where a beam from the transmitter and one from the receiver end on the same facet, they are joined, and
//! physical optics is integrated over the common polygon in closed form. [`mod@reference`] holds slow, obvious rivals that
//! share none of this.

mod error; // what can be wrong with a body or an antenna
mod antenna; // a point or a direction, and its images
mod plane; // of facets, and through antenna and edge
mod memory; // expected, watched, refused
mod bvh; // obvhs proposes candidates in single precision
mod patch; // coplanar facets that are one flat
mod welding; // vertices of one place
mod mesh_edges; // and the triangles at each edge
mod made_normals; // creases, and normals where a mesh stores none
mod curved_edge; // an edge bent by the normals at its ends
mod bend; // the skin's height over a facet
mod refinement; // bent triangles cut until they are flat
mod curved_skin; // a mesh's triangles, bent
mod skin; // what facets stand for
mod road; // a mirror, unfolded
mod world; // facets of posed bodies
mod border; // what ends a lit polygon
mod clip; // a convex polygon cut by a plane
mod section; // solid angle, or area across a direction
mod depth_order; // which of two facets is in front, decided once
mod view; // from where and through which hole
mod shadow; // what one facet hides
mod projection_grid; // what may stand before what in a direct view
mod sheets; // what waves have passed
mod visibility; // what a view shows
mod brute_force; // the same by trying all pairs
mod beam; // trees of lit polygons and their mirrors
mod divided_difference; // of exp: phase and polynomial over a triangle
mod polygon_phase; // a linear phase over a polygon, exactly
mod plane_frame; // coordinates in a facet's plane
mod polarization; // v and h of a leg, through its mirrors
mod complex_vector; // fields with phase
mod reflection_coefficients; // of a plane boundary
mod layers; // coefficients of plane layers
mod surface_response; // a material's coefficients, and what they do to a field
mod steps; // surfaces between an antenna and a node
mod tiling; // how far a polygon must be cut
mod physical_optics; // the integral over a lit polygon
mod lossy_node; // the same with reflection coefficients
mod convex_intersection; // where two beams overlap
mod own_edge; // weights of a sequence's nodes
mod join; // beams of both ends meet on a facet
mod scatterer; // joints with the way to them
mod weld; // corners that are one point
mod surface_topology; // triangles by shared lines, and flat patches
mod fringe; // currents of a wedge beyond physical optics
mod body_edges; // which edges of a mesh diffract
mod line_integral; // of a weight under a fast phase
mod world_edges; // edges of posed bodies
mod lit_edge; // which parts of edges both ends light
mod fresnel; // the Fresnel integral of an edge wave
mod face_end; // how far a face goes
mod end_current; // what is not there beyond the end of a face
mod edge_currents; // the fringe integral along an edge
mod edge_scattering; // S of all edges
mod joint_sum; // of many frequencies from few
mod meeting; // of both ends, in ways of one order
mod aspect; // S at one aspect, by order and node rule
mod rcs_table; // S over frequency and aspect
mod contributions; // S of one aspect by facet sequence
mod path_cells; // lit polygons as cells with one node each
mod edge_cells; // the same for lit edges
mod nearest_surface; // nearest lit point of a body
mod path_sum; // S from path records, by definition
mod path_plan; // what a frame is traced with
mod path_pruning; // paths too weak to matter
mod frame_error; // what a frame's paths miss, measured
mod path_table; // the largest cells that meet the accuracy
mod path; // the path table of a frame
mod rcs_frame; // the paper's table of a frame
pub mod reference;
#[cfg(test)]
mod test_quadrature;

pub use antenna::Antenna;
pub use beam::{Audit, Beam, BeamTree, OrderAudit, TraceSettings};
pub use contributions::{Contribution, contributions};
pub use error::BartError;
pub use memory::{MemoryLimit, memory_estimate_bytes};
pub use path::trace_frame;
pub use path_sum::{PathView, scattering_of_paths};
pub use plane::Plane;
pub use rcs_frame::rcs_frame;
pub use rcs_table::{RcsRequest, RcsResult, RcsSeconds, Standpoint, rcs, rcs_within};
pub use skin::{Role, Skin};
pub use world::{FacetGeometry, Models, World};
