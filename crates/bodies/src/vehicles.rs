//! The project's own vehicles of four classes, drawn from lines as by a coachbuilder: twelve parametric
//! models, and families whose proportions, parts and spreads are in tables
//! (`crates/bodies/vehicles/CLASS.toml`).
//!
//! A name and a seed give a closed-looking body of some 10⁴ facets: a [`Mesh`](artifact::scene::Mesh) in body
//! axes (x forward, y left, z up, metres, origin in the middle of the bounding box on the ground) with a unit
//! normal per vertex and named materials. Seed 0 gives the nominal dimensions, any other seed draws them from
//! the ranges of real vehicles, so that a dataset does not contain one shape a hundred times. Equal names and
//! seeds give equal bytes.
//!
//! Reading order: in `drawing`, `curve` draws lines, `shell` lofts them to a skin, `stencil` cuts panes,
//! arches and lamps into it along exact outlines, `solids` adds attached parts, `mesh_builder` scales,
//! smooths and rounds the whole; `glb` writes it. `family` draws from the tables; `loft` (cars, buses, cabs),
//! `heavy` (trucks) and `cycle` (two-wheelers) make meshes of them, and `catalogue` knows all names. Facets
//! are small on curved skin (5 to 10 cm on bodies, 2 to 5 cm on roundings) and of any size on flat skin; at
//! 77 GHz that is a faceted vehicle, not a smooth one (chord over √(ρλ) is above 0.7 below ρ ≈ 5 m): the
//! stored normals allow the curved skin to be reconstructed.
//!
//! ```
//! let suv = bodies::vehicles::vehicle("car-suv", 0).ok_or("unknown name")?;
//! let front = suv.mesh.vertices_m.iter().map(|v| v[0]).fold(0.0, f64::max);
//! assert!((front - 2.5).abs() < 1e-6);
//! let bytes = bodies::vehicles::glb(&suv);
//! assert_eq!(&bytes[..4], b"glTF");
//! # Ok::<(), &str>(())
//! ```

mod dimensions;
mod family;
mod drawing;
mod car;
mod bus;
mod truck;
mod motorcycle;
mod parts;
mod loft;
mod heavy;
mod cycle;
mod catalogue;
mod glb;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod family_tests;

pub use catalogue::{NAMES, class_of, crosses_of, families_of, mesh, names, ranges_m, vehicle};
pub use drawing::mesh_builder::Vehicle;
pub use glb::glb;
