//! Several filters of one body, one for each velocity that an aliased measurement may stand for.
//!
//! A map shows a velocity but for multiples of its span. Each multiple that a vehicle can drive has a filter,
//! all take the same measurements in, and each one's weight is multiplied by how likely it found them
//! (multiple models without switching, Bar-Shalom, Li, Kirubarajan 2001, §11.6.2). What tells them apart is
//! the range: a span of 32 m/s moves it by 3.2 m in a tenth of a second, 0.4 m where the radar's cells are
//! finest.

use crate::tracking::kalman::{Estimate, outer};
use crate::tracking::measurement::Measurement;
use crate::tracking::tracker_settings::TrackerSettings;
use glam::DMat4;

/// Filters and their weights, first that of the velocity that the first measurement showed, then by how far
/// they are turned from it; never empty.
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
        let outwards = (0..=turns).flat_map(|turn| [turn, -turn]).skip(1);
        let possible = outwards.filter(|t| *t == 0 || velocity_mps(*t).abs() <= settings.fastest_mps);
        let filters = possible.map(|t| (1.0, first.first_estimate(velocity_mps(t), settings.tangential_mps)));
        let mut bank = Self { filters: filters.collect() };
        bank.weigh();
        bank
    }

    /// Likeliest filter; of equally likely ones that which is turned least.
    pub(crate) fn best(&self) -> &Estimate {
        let best =
            self.filters.iter().skip(1).fold(&self.filters[0], |best, f| if f.0 > best.0 { f } else { best });
        &best.1
    }

    /// Covariance of the likeliest filter's state about the truth, whichever filter has it: as long as
    /// several are left, each one's own and its distance from that state count by its weight.
    pub(crate) fn covariance(&self) -> DMat4 {
        let told = self.best().mean;
        self.filters.iter().fold(DMat4::ZERO, |sum, (weight, state)| {
            let apart = state.mean - told;
            sum + (state.covariance + outer(apart, apart)) * *weight
        })
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tracking::measurement::Site;
    use crate::tracking::tracker_settings::ROAD_TRAFFIC;
    use artifact::points::{Height, Object};
    use artifact::radar::Multiplexing;
    use radar::{aperture::Preset, paper};

    /// Bank of an object at rest 40 m away, of a radar that takes turns; the span in m/s.
    fn bank_at_rest() -> (VelocityBank, f64) {
        let mut radar = paper::radar([0.0; 3], paper::waveform(256, 128), Preset::ThreeByFour.elements());
        radar.array.multiplexing = Multiplexing::Tdm;
        let object = Object {
            range_m: 40.0,
            radial_velocity_mps: 0.0,
            velocity_resolved: false,
            azimuth_rad: 0.0,
            height: Height::Assumed,
            position_m: [0.0, 40.0, 1.0],
            lane: None,
            snr_db: 40.0,
            points: 1,
            range_extent_m: [40.0; 2],
            velocity_extent_mps: [0.0; 2],
            ghost_share: None,
            stationary: None,
        };
        let measurement = Site::new(&radar).measurement(&object, &ROAD_TRAFFIC);
        (VelocityBank::new(&measurement, &ROAD_TRAFFIC), measurement.span_mps.unwrap())
    }

    #[test]
    fn a_body_at_rest_is_told_at_rest_and_as_uncertain_as_its_velocity_is() {
        let (bank, span_mps) = bank_at_rest();
        assert!(!bank.is_resolved());
        assert_eq!(bank.best().mean.w, 0.0, "the velocity that was shown, not the lowest of all");
        // Equally likely velocities that far apart spread by more than the nearest wrong one's share.
        let count = bank.filters.len() as f64;
        let spread_mps = bank.covariance().w_axis.w.sqrt();
        assert!(spread_mps > span_mps * (2.0 / count).sqrt(), "{spread_mps} of {span_mps} m/s");
        assert!(bank.best().covariance.w_axis.w.sqrt() < 1.0);
    }

    #[test]
    fn a_bank_of_one_filter_is_as_certain_as_that_is() {
        let (mut bank, _) = bank_at_rest();
        bank.filters.truncate(1);
        bank.weigh();
        assert_eq!(bank.covariance(), bank.best().covariance);
    }
}
