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
//! The stages (`scene`, `bart-rcs`, `fmcw-echo`, `dsp`, `classifier`) meet here and nowhere else; each hands
//! an artifact to the next. A room of this crate uses only rooms that stand before it in this list.

// Datasets alone use some of the rooms before them.
#![cfg_attr(not(feature = "classifier"), allow(dead_code))]

pub mod host;
pub mod chain;
pub mod planning;
pub mod outcome;
pub mod pictures;
pub mod report;
pub mod run;
pub mod sweep;
pub mod stepwise;
pub mod program;

pub use chain::cache::CacheLocation;
pub use chain::loading::SceneSource;
pub use host::call_off::CallOff;
pub use host::failure::Failure;
pub use host::memory::Allowance;
pub use outcome::summary::{RadarsSummary, Summary};
pub use run::{Outcome, Settings, run};
