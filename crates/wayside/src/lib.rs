//! Simulator from a 3D model to a vehicle class: a virtual traffic intersection, scattering at 77 GHz by
//! bidirectional analytic ray tracing (BART), FMCW echoes on a sparse array, range-Doppler maps, CFAR,
//! angles, point clouds, tracks, classes.
//!
//! ```no_run
//! let settings = wayside::Settings::of("scenes/intersection.toml", "out/intersection");
//! let outcome = wayside::run(&settings)?;
//! for target in outcome.summary().iter().flat_map(|summary| &summary.frames[0].targets) {
//!     println!("{}: {:?} m", target.id, target.estimate.map(|estimate| estimate.range_m));
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
pub use host::call_off::CallOff;
pub use host::failure::Failure;
pub use host::memory::Allowance;
pub use outcome::summary::{RadarsSummary, Summary};
pub use run::{Outcome, Settings, run};
