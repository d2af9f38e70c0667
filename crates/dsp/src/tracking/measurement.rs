//! Measurement of a body by an object: range, azimuth and radial velocity, each with a variance from its
//! strength, the radar's resolution and the body's own size.

use crate::spectrum::axes::Axes;
use crate::tracking::kalman::{Estimate, Innovation};
use crate::tracking::tracker_settings::TrackerSettings;
use artifact::Radar;
use artifact::points::Object;
use artifact::units::power_from_db;
use glam::{DVec2, DVec4};
use radar::doppler_ambiguity::{folded, folded_mps};
use std::f64::consts::{PI, TAU};

/// Properties of a radar used by a tracker.
#[derive(Debug, Clone)]
pub struct Site {
    place_m: DVec2,
    height_m: f64,
    boresight_az_rad: f64,
    range_cell_m: f64,
    velocity_cell_mps: f64,
    span_mps: f64,
    coupling_m_per_mps: f64,
    channels: f64,
    /// Variance of the virtual elements' positions along the row, half wavelengths squared.
    aperture: f64,
}

/// An object as input of a tracker.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measurement {
    /// Range from the array's centre.
    pub range_m: f64,
    /// Azimuth from +y towards +x.
    pub azimuth_rad: f64,
    /// Height above the radar, which is not part of the state.
    pub up_m: f64,
    /// Radial velocity of the object.
    pub radial_velocity_mps: f64,
    /// Velocity ambiguity; `None` if the object's velocity is resolved.
    pub span_mps: Option<f64>,
    /// Variances of range, of azimuth at the object's position, and of radial velocity; infinite if not
    /// measured.
    pub variance: [f64; 3],
    coupling_m_per_mps: f64,
    site_m: DVec2,
    direction: DirectionError,
}

/// Errors of an object's azimuth: that of its direction cosine u = cos ε·sin(α − α₀), and the position across
/// the body.
#[derive(Debug, Clone, Copy, PartialEq)]
struct DirectionError {
    cosine_variance: f64,
    /// Factor cos² ε.
    flatness2: f64,
    boresight_az_rad: f64,
    across_variance: f64,
}

impl DirectionError {
    /// Variance of an azimuth, rad²: du/dα is 1 along the boresight and less beside it. Along the row it is
    /// zero, and the error of α is limited by 1 − u = (α − α₀ ∓ π/2)²/2.
    fn azimuth_variance(&self, azimuth_rad: f64) -> f64 {
        let slope2 = self.flatness2 * (azimuth_rad - self.boresight_az_rad).cos().powi(2);
        (self.cosine_variance / slope2).min(self.cosine_variance.sqrt()) + self.across_variance
    }
}

impl Site {
    /// Site of a radar already checked for cells and elements.
    pub fn new(radar: &Radar) -> Self {
        let place = radar.position_m;
        let spread = |elements: &[[f64; 2]]| {
            let count = elements.len().max(1) as f64;
            let mean = elements.iter().map(|e| e[0]).sum::<f64>() / count;
            elements.iter().map(|e| (e[0] - mean).powi(2)).sum::<f64>() / count
        };
        Self {
            place_m: DVec2::new(place[0], place[1]),
            height_m: place[2],
            boresight_az_rad: radar.boresight_az_rad,
            range_cell_m: radar.waveform.range_resolution_m(),
            velocity_cell_mps: radar.velocity_resolution_mps().abs(),
            span_mps: 2.0 * radar.velocity_max_mps().abs(),
            coupling_m_per_mps: Axes::of(radar).coupling_m(1.0),
            channels: radar.virtual_channels() as f64,
            aperture: spread(&radar.array.tx_half_wavelengths) + spread(&radar.array.rx_half_wavelengths),
        }
    }

    /// Position of the radar on the road.
    pub fn place_m(&self) -> DVec2 {
        self.place_m
    }

    /// Width of a range cell, m.
    pub fn range_cell_m(&self) -> f64 {
        self.range_cell_m
    }

    /// Measurement of a body by an object.
    ///
    /// Noise: the Cramér–Rao bounds of a tone's frequency in cells, 6/(2π)²ρ, and of the direction cosine
    /// over elements that spread by σ half wavelengths, 1/2π²σ²ρ, ρ the power over noise of all channels.
    /// Size: the reflecting part is uniformly distributed between the body's ends, with a variance of a
    /// twelfth of their distance squared. Points on the slopes of the two outermost peaks lie a cell beyond
    /// them; echoes less than a cell apart form one peak between them.
    pub fn measurement(&self, object: &Object, settings: &TrackerSettings) -> Measurement {
        let strength = power_from_db(object.snr_db).max(1.0) * self.channels;
        let tone = 6.0 / (TAU * TAU * strength);
        let even = |extent: [f64; 2], cell: f64| {
            ((extent[1] - extent[0]).abs() - 2.0 * cell).max(cell).powi(2) / 12.0
        };
        let across = settings.body_width_m.powi(2) / (12.0 * object.range_m.max(self.range_cell_m).powi(2));
        let up = (object.position_m[2] - self.height_m) / object.range_m.max(self.range_cell_m);
        let direction = DirectionError {
            cosine_variance: 0.5 / (PI * PI * self.aperture * strength),
            flatness2: (1.0 - up * up).max(0.0),
            boresight_az_rad: self.boresight_az_rad,
            across_variance: across,
        };
        Measurement {
            range_m: object.range_m,
            azimuth_rad: object.azimuth_rad,
            up_m: object.position_m[2] - self.height_m,
            radial_velocity_mps: object.radial_velocity_mps,
            span_mps: (!object.velocity_resolved).then_some(self.span_mps),
            variance: [
                tone * self.range_cell_m.powi(2) + even(object.range_extent_m, self.range_cell_m),
                direction.azimuth_variance(object.azimuth_rad),
                tone * self.velocity_cell_mps.powi(2)
                    + even(object.velocity_extent_mps, self.velocity_cell_mps),
            ],
            coupling_m_per_mps: self.coupling_m_per_mps,
            site_m: self.place_m,
            direction,
        }
    }
}

/// State updated by a measurement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Update {
    /// Updated state.
    pub estimate: Estimate,
    /// Squared Mahalanobis distance.
    pub distance2: f64,
    /// −2 ln of the measurement's density.
    pub neg2_log_likelihood: f64,
}

impl Measurement {
    /// Initial state of the body from a first measurement, with its covariance: measured components along and
    /// across the line of sight; the velocity across it is unknown up to `tangential_mps`.
    /// `radial_velocity_mps` is one of the candidates for the ambiguous velocity.
    pub fn first_estimate(&self, radial_velocity_mps: f64, tangential_mps: f64) -> Estimate {
        let (sin, cos) = self.azimuth_rad.sin_cos();
        let (along, across) = (DVec2::new(sin, cos), DVec2::new(cos, -sin));
        let range_m =
            self.range_m - self.coupling_m_per_mps * (radial_velocity_mps - self.radial_velocity_mps);
        let ground_m = (range_m * range_m - self.up_m * self.up_m).max(0.0).sqrt().max(MIN_GROUND_M);
        let slant = range_m.max(ground_m) / ground_m;
        let place = self.site_m + along * ground_m;
        let velocity = along * radial_velocity_mps * slant;
        // An array that measures no azimuth leaves half a circle in front of it: a standard deviation of 0.5
        // rad.
        let azimuth = self.variance[1].min(0.25);
        // An azimuth error projects a share of the velocity across onto the line of sight.
        let rate = self.variance[2] + azimuth * tangential_mps * tangential_mps;
        let blocks = [
            (along, self.variance[0] * slant * slant, rate * slant * slant),
            (across, azimuth * ground_m * ground_m, tangential_mps * tangential_mps),
        ];
        let mut covariance = glam::DMat4::ZERO;
        for (direction, of_place, of_velocity) in blocks {
            let (p, v) = (direction.extend(0.0).extend(0.0), DVec4::new(0.0, 0.0, direction.x, direction.y));
            covariance += crate::tracking::kalman::outer(p, p) * of_place
                + crate::tracking::kalman::outer(v, v) * of_velocity;
        }
        Estimate { mean: DVec4::new(place.x, place.y, velocity.x, velocity.y), covariance }
    }

    /// Variance of the azimuth at its predicted value; the measured one depends on its own error.
    fn azimuth_variance_at(&self, azimuth_rad: f64) -> f64 {
        let of = |azimuth_rad| self.direction.azimuth_variance(azimuth_rad);
        self.variance[1] * of(azimuth_rad) / of(self.azimuth_rad)
    }

    /// Measured minus predicted radial velocity, on the velocity circle.
    pub fn rate_residual_mps(&self, state: &Estimate) -> f64 {
        let apart_mps = self.radial_velocity_mps - PolarState::of(self, state).rate_mps;
        self.span_mps.map_or(apart_mps, |span| folded_mps(apart_mps, span))
    }

    /// Measured minus predicted azimuth.
    pub fn azimuth_residual_rad(&self, state: &Estimate) -> f64 {
        turned(self.azimuth_rad - PolarState::of(self, state).azimuth_rad)
    }

    /// Extended Kalman filter update, each scalar linearised at the result of those before it.
    pub fn updated(&self, expected: &Estimate) -> Update {
        let polar = PolarState::of(self, expected);
        let turns =
            self.span_mps.map_or(0.0, |span| ((polar.rate_mps - self.radial_velocity_mps) / span).round());
        let unfolded_mps = self.radial_velocity_mps + turns * self.span_mps.unwrap_or(0.0);
        let range_m = self.range_m - self.coupling_m_per_mps * (unfolded_mps - self.radial_velocity_mps);
        let mut update = Update { estimate: *expected, distance2: 0.0, neg2_log_likelihood: 0.0 };
        update.take(polar.range_row(), range_m - polar.range_m, self.variance[0]);
        if self.variance[1].is_finite() {
            let polar = PolarState::of(self, &update.estimate);
            let variance = self.azimuth_variance_at(polar.azimuth_rad);
            update.take(polar.azimuth_row(), turned(self.azimuth_rad - polar.azimuth_rad), variance);
        }
        let polar = PolarState::of(self, &update.estimate);
        let variance = self.variance[2] + polar.bend_variance(&update.estimate);
        update.take(polar.rate_row(&update.estimate), unfolded_mps - polar.rate_mps, variance);
        polar.keep_bend(&mut update.estimate);
        update
    }
}

/// Minimum ground range, since a body under the antenna would have no direction.
const MIN_GROUND_M: f64 = 0.1;

impl Update {
    fn take(&mut self, row: DVec4, residual: f64, variance: f64) {
        let innovation: Innovation = self.estimate.innovation(row, residual, variance);
        self.distance2 += innovation.distance2();
        self.neg2_log_likelihood += innovation.neg2_log_likelihood();
        self.estimate = self.estimate.updated(row, residual, variance);
    }
}

/// A state in the radar's coordinates.
struct PolarState {
    away_m: DVec2,
    range_m: f64,
    azimuth_rad: f64,
    rate_mps: f64,
}

impl PolarState {
    fn of(measurement: &Measurement, state: &Estimate) -> Self {
        let mut away_m = DVec2::new(state.mean.x, state.mean.y) - measurement.site_m;
        if away_m.length() < MIN_GROUND_M {
            away_m = DVec2::new(0.0, MIN_GROUND_M);
        }
        let range_m = away_m.length().hypot(measurement.up_m);
        let rate_mps = away_m.dot(DVec2::new(state.mean.z, state.mean.w)) / range_m;
        Self { away_m, range_m, azimuth_rad: away_m.x.atan2(away_m.y), rate_mps }
    }

    fn range_row(&self) -> DVec4 {
        (self.away_m / self.range_m).extend(0.0).extend(0.0)
    }

    fn azimuth_row(&self) -> DVec4 {
        (DVec2::new(self.away_m.y, -self.away_m.x) / self.away_m.length_squared()).extend(0.0).extend(0.0)
    }

    fn rate_row(&self, state: &Estimate) -> DVec4 {
        let toward = self.away_m / self.range_m;
        let by_place = (DVec2::new(state.mean.z, state.mean.w) - toward * self.rate_mps) / self.range_m;
        DVec4::new(by_place.x, by_place.y, toward.x, toward.y)
    }

    /// Variance due to the bilinearity of the radial velocity in direction and velocity across: E[(δv·δs/R)²]
    /// for Gaussian errors. For a young track (10 m/s, 0.8 m at 40 m) this is 0.2 m/s, more than a Doppler
    /// cell.
    fn bend_variance(&self, state: &Estimate) -> f64 {
        let across = DVec2::new(self.away_m.y, -self.away_m.x) / self.away_m.length();
        let (p, v) = (across.extend(0.0).extend(0.0), DVec4::new(0.0, 0.0, across.x, across.y));
        let [place, velocity] = [p.dot(state.covariance * p), v.dot(state.covariance * v)];
        (place * velocity + p.dot(state.covariance * v).powi(2)) / (self.range_m * self.range_m)
    }

    /// Keeps that error in the covariance: it is the same from frame to frame and does not average out, so
    /// the velocity along the line of sight is never known better.
    fn keep_bend(&self, state: &mut Estimate) {
        let toward = self.away_m / self.away_m.length();
        let v = DVec4::new(0.0, 0.0, toward.x, toward.y);
        let lacking = self.bend_variance(state) - v.dot(state.covariance * v);
        state.covariance += crate::tracking::kalman::outer(v, v) * lacking.max(0.0);
    }
}

/// An angle wrapped to −π … π.
pub(crate) fn turned(angle_rad: f64) -> f64 {
    folded(angle_rad, TAU)
}
