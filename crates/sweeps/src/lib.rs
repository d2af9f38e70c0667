//! Studies: many designs of a scene's radar tried in the same situations, and which of them to take
//! (`docs/sweeps.md`).
//!
//! A study file goes in ([`Settings`]); [`run`] makes every run of it, in parts where that is asked for,
//! keeps each, and leaves tables, a picture and a report ([`Outcome`]).
//!
//! Reading order is that of the rooms below; each uses only those that stand before it.

mod statistics; // how sure a mean is, and which designs are worse for sure
mod metrics; // what is measured of a run
mod study; // the file, its designs and its situations
mod runs; // a design in a situation, and what of it is kept
mod answer; // which design to take
mod rounds; // the runs that are made, round by round
mod told; // tables, picture, report
mod sweep; // all of the above for one study

pub use sweep::{Outcome, Settings, run};
