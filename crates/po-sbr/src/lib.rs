//! Slow, obvious reference methods: [`po`] (first order, dense sampling), [`sbr`] (shooting and bouncing
//! rays) and [`iterative_po`] (two bounces without mirrors: currents in the near field of currents).
//!
//! Input are a mesh, an aspect and frequencies; output is the scattering amplitude S in metres, 2 × 2 over
//! polarization. Visibility and integration share no code with the beam tracer: separate rays decide what is
//! lit, and sums over small cells replace closed forms; reflection by materials has its own formulas. The
//! references are exact in the limit of high density, and are compared as they converge.
//!
//! ```
//! use artifact::{scene::Mesh, settings::Sides};
//! use radar::standpoint::Standpoint;
//! use po_sbr::{Aspect, Bracket, po};
//! // A square of 2 cm seen square: S = +j√(4π)·A/λ (docs/physics.md §0).
//! let corner = |y: f64, z: f64| [0.0, 0.01 * y, 0.01 * z];
//! let plate = Mesh {
//!     vertices_m: vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
//!     triangles: vec![[0, 1, 2], [0, 2, 3]],
//!     ..Mesh::default()
//! };
//! let ahead = Standpoint { azimuth_rad: 0.0, elevation_rad: 0.0, range_m: f64::INFINITY };
//! let sampling = po::Sampling {
//!     per_wavelength: 2.0,
//!     shadow_levels: 0,
//!     sides: Sides::Two,
//!     bracket: Bracket::Symmetrised,
//! };
//! let s = po::amplitude(&plate, &Aspect::monostatic(ahead), &[77e9], &sampling)?;
//! let expected = (4.0 * std::f64::consts::PI).sqrt() * 4e-4 / (299_792_458.0 / 77e9);
//! assert!((s[0][0][0].im - expected).abs() < 1e-9 * expected);
//! # Ok::<(), po_sbr::ReferenceError>(())
//! ```

mod aspect;
mod node;
mod ray_cast;
pub mod plane_layers;
mod coated;
pub mod po;
pub mod sbr;
pub mod iterative_po;
#[cfg(test)]
mod verification;

pub use aspect::Aspect;
pub use node::Bracket;
pub use ray_cast::ReferenceError;
