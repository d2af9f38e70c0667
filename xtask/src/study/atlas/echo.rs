//! Echoes: failures between paths and samples.

mod frozen;
mod interference;
mod levels;
mod many;

use crate::study::atlas::verdict::{AtlasCase, atlas_cases};

pub(super) const CASES: &[AtlasCase] = atlas_cases![
    frozen::near_lane,
    frozen::single_precision,
    many::wheels,
    many::targets,
    many::motion,
    many::long_runs,
    levels::extremes,
    levels::saturated,
    interference::same_slope,
    interference::ghosts_of_no_body,
    interference::crossings,
    interference::weak_among_radars,
];
