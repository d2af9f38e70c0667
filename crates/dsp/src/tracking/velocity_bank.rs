//! Bank of filters for one body, one for each candidate of an aliased velocity.
//!
//! A map measures a velocity modulo its span. Each candidate that a vehicle can drive has a filter, all
//! process the same measurements, and each filter's weight is multiplied by the likelihood that it assigns to
//! them (static multiple-model estimator, Bar-Shalom, Li, Kirubarajan 2001, §11.6.2). The range distinguishes
//! them: a span of 32 m/s shifts it by 3.2 m in a tenth of a second, 0.4 m where the radar's cells are
//! finest.

use crate::tracking::kalman::{Estimate, outer};
use crate::tracking::measurement::Measurement;
use crate::tracking::tracker_settings::TrackerSettings;
use glam::DMat4;

/// Filters and their weights, first that of the apparent velocity of the first measurement, then by the
/// number of spans from it; never empty.
#[derive(Debug, Clone)]
pub(crate) struct VelocityBank {
    filters: Vec<(f64, Estimate)>,
}

/// Weight below which a filter is dropped: one track in a thousand is resolved wrongly if models are true.
const LEAST_WEIGHT: f64 = 1e-3;

/// Fit of a measurement to a bank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MeasurementFit {
    /// Minimum squared Mahalanobis distance.
    pub(crate) distance2: f64,
    /// −2 ln of the measurement's density.
    pub(crate) neg2_log_likelihood: f64,
}

impl VelocityBank {
    /// All candidates of a first measurement's velocity up to the maximum speed, with equal weights; at least
    /// the apparent one.
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

    /// Likeliest filter; among equally likely ones the one fewest spans away.
    pub(crate) fn best(&self) -> &Estimate {
        let best =
            self.filters.iter().skip(1).fold(&self.filters[0], |best, f| if f.0 > best.0 { f } else { best });
        &best.1
    }

    /// Covariance of the likeliest filter's state about the truth, whichever filter is true: while several
    /// remain, the covariance of each and its distance from that state contribute by weight.
    pub(crate) fn covariance(&self) -> DMat4 {
        let told = self.best().mean;
        self.filters.iter().fold(DMat4::ZERO, |sum, (weight, state)| {
            let apart = state.mean - told;
            sum + (state.covariance + outer(apart, apart)) * *weight
        })
    }

    /// Whether a single filter remains.
    pub(crate) fn is_resolved(&self) -> bool {
        self.filters.len() == 1
    }

    /// Predicts every filter.
    pub(crate) fn predict(&mut self, interval_s: f64, acceleration_density: f64) {
        self.filters.iter_mut().for_each(|f| f.1 = f.1.predicted(interval_s, acceleration_density));
    }

    /// Fit of a measurement to the bank: minimum distance, and the density over all filters.
    pub(crate) fn fit(&self, measurement: &Measurement) -> MeasurementFit {
        let updates = self.filters.iter().map(|(weight, state)| (weight, measurement.updated(state)));
        let (mut distance2, mut least) = (f64::INFINITY, f64::INFINITY);
        let mut neg2_log_likelihoods = Vec::new();
        for (weight, update) in updates {
            distance2 = distance2.min(update.distance2);
            neg2_log_likelihoods.push(update.neg2_log_likelihood - 2.0 * weight.ln());
            least = least.min(update.neg2_log_likelihood - 2.0 * weight.ln());
        }
        let sum: f64 = neg2_log_likelihoods.iter().map(|s| (0.5 * (least - s)).exp()).sum();
        MeasurementFit { distance2, neg2_log_likelihood: least - 2.0 * sum.ln() }
    }

    /// Updates all filters by a measurement.
    pub(crate) fn update(&mut self, measurement: &Measurement) {
        let updates: Vec<_> =
            self.filters.iter().map(|(w, state)| (*w, measurement.updated(state))).collect();
        let least = updates.iter().map(|(_, u)| u.neg2_log_likelihood).fold(f64::INFINITY, f64::min);
        self.filters = updates
            .into_iter()
            .map(|(w, u)| (w * (0.5 * (least - u.neg2_log_likelihood)).exp(), u.estimate))
            .collect();
        self.weigh();
    }

    /// Normalises the weights and drops filters of low weight.
    fn weigh(&mut self) {
        let best = self.filters.iter().map(|f| f.0).fold(0.0, f64::max);
        self.filters.retain(|f| f.0 >= LEAST_WEIGHT * best);
        let sum: f64 = self.filters.iter().map(|f| f.0).sum();
        self.filters.iter_mut().for_each(|f| f.0 /= sum);
    }
}

/// Maximum number of spans; with more folds an affordable bank would resolve nothing.
const MOST_TURNS: i32 = 32;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tracking::measurement::Site;
    use crate::tracking::tracker_settings::ROAD_TRAFFIC;
    use artifact::points::{Height, Object};
    use artifact::radar::Multiplexing;
    use radar::{aperture::Preset, paper};

    /// Bank of an object at rest 40 m away, for a time-division radar; the span in m/s.
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
        // Equally likely velocities that far apart spread by more than the share of the nearest wrong one.
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
