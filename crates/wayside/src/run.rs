//! Run of a scene to all of its results: artifacts, `summary.json`, report and pictures.

mod products;
mod radar_outcome;
pub(crate) mod leftovers;
mod earlier_results;
mod several_radars;
mod scene_run;

pub use radar_outcome::RadarOutcome;
pub use scene_run::{Outcome, Settings, run};
