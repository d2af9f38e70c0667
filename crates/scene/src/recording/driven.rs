//! Ways of a whole recording by speeds and by places, which tell coordinates that are no metres.

use crate::recording::fcd::FcdRule;
use crate::recording::interpolation::Interval;

/// Ways of all vehicles so far.
#[derive(Default)]
pub(crate) struct Driven {
    /// Way by the speeds that are told.
    told_m: f64,
    /// Way by their places.
    way_m: f64,
}

/// Ways by speeds from which on they say something of places.
const TELLING_M: f64 = 20.0;
/// Least part of it that places show, if they show any: a degree of latitude is 111 km, so that degrees show
/// 1e-5.
const LEAST_SHARE: f64 = 1e-3;

impl Driven {
    /// Adds an interval.
    pub(crate) fn take(&mut self, interval: &Interval) {
        let [told_m, way_m] = interval.ways_m();
        self.told_m += told_m;
        self.way_m += way_m;
    }

    /// Refuses ways that no such speeds make.
    pub(crate) fn checked(&self) -> Result<(), FcdRule> {
        let Self { told_m, way_m } = *self;
        if told_m > TELLING_M && way_m > 0.0 && way_m < LEAST_SHARE * told_m {
            return Err(FcdRule::NotMetres { told_m, way_m });
        }
        Ok(())
    }
}
