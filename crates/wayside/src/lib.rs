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
//! artifact to the next. Pictures and pages are made by `reporting`, studies by `sweeps`, foreign files are
//! read and written by `formats`, datasets and models are made by `learning`. Here stands what uses all of
//! these; what a program of others needs of them is handed on below.
//!
//! Reading order is that of the rooms below; each uses only those that stand before it.

mod remarks; // what is perhaps not meant so
pub mod run; // a scene to everything
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
