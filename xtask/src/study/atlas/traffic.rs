//! Traffic: intersecting and nearby bodies, and the road under them.

mod overlapping;
mod road;

use crate::study::atlas::verdict::{AtlasCase, atlas_cases};

pub(super) const CASES: &[AtlasCase] =
    atlas_cases![overlapping::boxes, overlapping::twice, overlapping::nearer_than_long, road::brewster];
