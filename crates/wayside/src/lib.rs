//! Simulator from a 3D model to a vehicle class: a virtual traffic intersection, scattering at 77 GHz by
//! bidirectional analytic ray tracing (BART), FMCW echoes on a sparse array, range-Doppler maps, CFAR,
//! angles, point clouds, tracks, classes.
//!
//! ```no_run
//! let outcome = wayside::run(&wayside::Settings::of("scenes/intersection.toml", "out/intersection"))?;
//! for object in outcome.points()?.iter().flat_map(|frame| &frame.objects) {
//!     println!("{:.2} m, {:.2} m/s", object.range_m, object.radial_velocity_mps);
//! }
//! # Ok::<(), wayside::Failure>(())
//! ```
//!
//! The stages (`scene`, `bart-rcs`, `fmcw-echo`, `dsp`, `classifier`) meet in `pipeline`; each hands an
//! artifact to the next. `reporting` makes pictures and pages, `sweeps` studies, `formats` reads and writes
//! foreign files, and `learning` makes datasets and models. This crate uses all of them and re-exports below
//! the items that other programs need.
//!
//! Read the rooms below in their order; each uses only those before it.

mod remarks; // input that is perhaps a mistake
pub mod run; // a scene to all of its results
pub mod stepwise; // a scene stage by stage in memory
pub mod program; // command line, a file per command

#[cfg(feature = "classifier")]
pub use ::learning;
pub use pipeline::{chain, host, outcome, planning};
pub use reporting::{pictures, report};
pub use sweeps as sweep;

pub use chain::cache::CacheLocation;
pub use chain::loading::SceneSource;
pub use host::cancellation::Cancellation;
pub use host::failure::Failure;
pub use host::memory::Allowance;
pub use outcome::summary::{RadarsSummary, Summary};
pub use run::{Outcome, RadarOutcome, Settings, run};
