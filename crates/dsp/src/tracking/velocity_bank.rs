//! Several filters of one body, one for each velocity that an aliased measurement may stand for.
//!
//! A map shows a velocity but for multiples of its span. Each multiple that a vehicle can drive has a filter,
//! all take the same measurements in, and each one's weight is multiplied by how likely it found them
//! (multiple models without switching, Bar-Shalom, Li, Kirubarajan 2001, §11.6.2). What tells them apart is
//! the range: a span of 32 m/s moves it by 3.2 m in a tenth of a second, 0.4 m where the radar's cells are
//! finest.

use crate::tracking::kalman::Estimate;
use crate::tracking::measurement::Measurement;
use crate::tracking::tracker_settings::TrackerSettings;

/// Filters and their weights; never empty.
#[derive(Debug, Clone)]
pub(crate) struct VelocityBank {
    filters: Vec<(f64, Estimate)>,
}

/// A filter this unlikely is given up: one track in a thousand is resolved wrongly if models are true.
const LEAST_WEIGHT: f64 = 1e-3;

/// Fit of a measurement to a bank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Suit {
    /// Least squared Mahalanobis distance.
    pub(crate) distance2: f64,
    /// −2 ln of the measurement's density.
    pub(crate) surprise: f64,
}

impl VelocityBank {
    /// All velocities up to the fastest that a first measurement may stand for, equally likely; at least the
    /// one it shows.
    pub(crate) fn new(first: &Measurement, settings: &TrackerSettings) -> Self {
        let shown_mps = first.radial_velocity_mps;
        let turns =
            first.span_mps.map_or(0, |span| ((settings.fastest_mps + shown_mps.abs()) / span).ceil() as i32);
        let velocity_mps = |turn: i32| shown_mps + f64::from(turn) * first.span_mps.unwrap_or(0.0);
        let turns = turns.min(MOST_TURNS);
        let possible = (-turns..=turns).filter(|t| *t == 0 || velocity_mps(*t).abs() <= settings.fastest_mps);
        let filters = possible.map(|t| (1.0, first.first_estimate(velocity_mps(t), settings.tangential_mps)));
        let mut bank = Self { filters: filters.collect() };
        bank.weigh();
        bank
    }

    /// Likeliest filter.
    pub(crate) fn best(&self) -> &Estimate {
        let best =
            self.filters.iter().skip(1).fold(&self.filters[0], |best, f| if f.0 > best.0 { f } else { best });
        &best.1
    }

    /// Whether one filter is left.
    pub(crate) fn is_resolved(&self) -> bool {
        self.filters.len() == 1
    }

    /// Every filter after some time.
    pub(crate) fn predict(&mut self, interval_s: f64, acceleration_density: f64) {
        self.filters.iter_mut().for_each(|f| f.1 = f.1.predicted(interval_s, acceleration_density));
    }

    /// Fit of a measurement to the bank: least distance, and the density over all filters.
    pub(crate) fn suit(&self, measurement: &Measurement) -> Suit {
        let updates = self.filters.iter().map(|(weight, state)| (weight, measurement.updated(state)));
        let (mut distance2, mut least) = (f64::INFINITY, f64::INFINITY);
        let mut surprises = Vec::new();
        for (weight, update) in updates {
            distance2 = distance2.min(update.distance2);
            surprises.push(update.surprise - 2.0 * weight.ln());
            least = least.min(update.surprise - 2.0 * weight.ln());
        }
        let sum: f64 = surprises.iter().map(|s| (0.5 * (least - s)).exp()).sum();
        Suit { distance2, surprise: least - 2.0 * sum.ln() }
    }

    /// Takes a measurement in.
    pub(crate) fn update(&mut self, measurement: &Measurement) {
        let updates: Vec<_> =
            self.filters.iter().map(|(w, state)| (*w, measurement.updated(state))).collect();
        let least = updates.iter().map(|(_, u)| u.surprise).fold(f64::INFINITY, f64::min);
        self.filters =
            updates.into_iter().map(|(w, u)| (w * (0.5 * (least - u.surprise)).exp(), u.estimate)).collect();
        self.weigh();
    }

    /// Weights that add up to one, without those that are given up.
    fn weigh(&mut self) {
        let best = self.filters.iter().map(|f| f.0).fold(0.0, f64::max);
        self.filters.retain(|f| f.0 >= LEAST_WEIGHT * best);
        let sum: f64 = self.filters.iter().map(|f| f.0).sum();
        self.filters.iter_mut().for_each(|f| f.0 /= sum);
    }
}

/// Radars that fold more often than this are told nothing by a bank that could be afforded.
const MOST_TURNS: i32 = 32;
