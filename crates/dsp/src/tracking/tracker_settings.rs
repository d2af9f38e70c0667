//! Settings of a tracker: models of bodies and of the detector, with values for road traffic.

/// Models of bodies and of the detector used by a tracker.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackerSettings {
    /// Spectral density of a body's acceleration, m²/s³ along each axis.
    pub acceleration_density: f64,
    /// Standard deviation of a new body's velocity across the line of sight, m/s.
    pub tangential_mps: f64,
    /// Maximum speed of a body, m/s.
    pub fastest_mps: f64,
    /// Width of a body, m; the reflecting part is anywhere across it.
    pub body_width_m: f64,
    /// Gate: maximum squared Mahalanobis distance (three degrees of freedom) of a track's own object.
    pub gate_distance2: f64,
    /// Probability that a body in view yields an object in a frame.
    pub detection_probability: f64,
    /// Density of objects in a frame that belong to no known body, per m, m/s and rad.
    pub new_object_density: f64,
    /// Number of objects M needed to confirm a new track …
    pub confirmed_by: u32,
    /// … within its first N frames.
    pub confirmed_within: u32,
    /// Time that confirmed tracks survive their last object, as a share of the time that they were seen …
    pub coast_share: f64,
    /// … between these limits, s.
    pub coast_s: [f64; 2],
}

/// Vehicles on roads. Acceleration: 3 m/s² for about a second, σ²τ = 9 (Singer 1970, IEEE Trans. AES 6, 473,
/// halves it for the share of time that it is used). Gate: all but 1e-5 of a χ² with three degrees of
/// freedom. New objects: one per frame in 60 m × 30 m/s × 1 rad.
pub const ROAD_TRAFFIC: TrackerSettings = TrackerSettings {
    acceleration_density: 4.5,
    tangential_mps: 10.0,
    fastest_mps: 45.0,
    body_width_m: 2.0,
    gate_distance2: 25.9,
    detection_probability: 0.9,
    new_object_density: 1.0 / (60.0 * 30.0),
    confirmed_by: 3,
    confirmed_within: 5,
    coast_share: 0.25,
    coast_s: [0.25, 1.0],
};
