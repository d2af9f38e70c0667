//! Traffic: intersecting and nearby bodies, and the road under them.

mod overlapping;
mod road;

use crate::study::atlas::verdict::{Tried, tried};

pub(super) const CASES: &[Tried] =
    tried![overlapping::boxes, overlapping::twice, overlapping::nearer_than_long, road::brewster];
