//! Signals: failures between samples and tracks.

mod strongest;
mod ambiguity;
mod clutter;
mod detector;
mod ends;
mod pairs;
mod tracking;

use crate::study::atlas::verdict::{AtlasCase, atlas_cases};

pub(super) const CASES: &[AtlasCase] = atlas_cases![
    ambiguity::velocity,
    ambiguity::range,
    ambiguity::transmitters_in_turn,
    ambiguity::beyond_the_bands,
    ambiguity::crossing_cells,
    ends::ranges,
    ends::at_the_radar,
    ends::speeds,
    ends::waveforms,
    ends::directions,
    ends::grating_lobes,
    pairs::one_cell,
    pairs::dynamic_range,
    pairs::doppler_bands,
    pairs::side_by_side,
    detector::all,
    clutter::steps,
    clutter::without_target,
    clutter::noise_alone,
    tracking::passing,
    tracking::hidden,
    tracking::impossible_frames,
];
