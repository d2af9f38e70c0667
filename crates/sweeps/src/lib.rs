//! Studies: try many designs of a scene's radar in the same situations, and select one (`docs/sweeps.md`).
//!
//! The input is a study file ([`Settings`]); [`run`] makes all of its runs, in parts if requested, keeps
//! each, and writes tables, a picture and a report ([`Outcome`]).
//!
//! Read the rooms below in their order; each uses only those before it.

mod statistics; // intervals of means, and designs that are certainly worse
mod metrics; // metrics of a run
mod study; // the file, its designs and its situations
mod runs; // a design in a situation, and its kept results
mod answer; // the selected design
mod study_run; // runs, repeat by repeat
mod outputs; // tables, picture, report
mod sweep; // all of the above for one study

pub use sweep::{Outcome, Settings, run};
