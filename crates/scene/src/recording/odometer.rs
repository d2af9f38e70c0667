//! Distances driven in a whole recording, by speeds and by positions: they reveal coordinates not in metres.

use crate::recording::fcd::FcdRule;
use crate::recording::interpolation::Interval;

/// Distances driven by all vehicles so far.
#[derive(Default)]
pub(crate) struct Odometer {
    /// Distance by the recorded speeds.
    told_m: f64,
    /// Distance by the positions.
    way_m: f64,
}

/// Least distance by speeds that allows a check of the positions.
const LEAST_CHECKED_M: f64 = 20.0;
/// Least ratio of the distance by positions to it, if positions change at all: a degree of latitude is 111
/// km, so that degrees give 1e-5.
const LEAST_SHARE: f64 = 1e-3;

impl Odometer {
    /// Adds an interval.
    pub(crate) fn add(&mut self, interval: &Interval) {
        let [told_m, way_m] = interval.driven_m();
        self.told_m += told_m;
        self.way_m += way_m;
    }

    /// Refuses positions that are inconsistent with the speeds.
    pub(crate) fn checked(&self) -> Result<(), FcdRule> {
        let Self { told_m, way_m } = *self;
        if told_m > LEAST_CHECKED_M && way_m > 0.0 && way_m < LEAST_SHARE * told_m {
            return Err(FcdRule::NotMetres { told_m, way_m });
        }
        Ok(())
    }
}
