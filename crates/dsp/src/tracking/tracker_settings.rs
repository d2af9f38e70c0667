//! Settings of a tracker: expectations of bodies and of the detector, and their values on roads.

/// Expectations that a tracker has of bodies and of the detector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackerSettings {
    /// Spectral density of a body's acceleration, m²/s³ along each axis.
    pub acceleration_density: f64,
    /// Standard deviation of a new body's velocity across the line of sight, m/s.
    pub tangential_mps: f64,
    /// No body is faster, m/s.
    pub fastest_mps: f64,
    /// Width of a body; what reflects is anywhere across it.
    pub body_width_m: f64,
    /// Largest squared Mahalanobis distance (three degrees of freedom) of a track's own object.
    pub gate_distance2: f64,
    /// That a body in view becomes an object in a frame.
    pub detection_probability: f64,
    /// Objects in a frame that are no known body's, per m, m/s and rad.
    pub new_object_density: f64,
    /// Objects that a new track needs …
    pub confirmed_by: u32,
    /// … in as many first frames.
    pub confirmed_within: u32,
    /// Believed tracks outlive their last object by this share of the time that they were seen …
    pub coast_share: f64,
    /// … but by no less and no more than these, s.
    pub coast_s: [f64; 2],
}

/// Vehicles on roads. Acceleration: 3 m/s² that lasts about a second, σ²τ = 9 (Singer 1970, IEEE Trans. AES
/// 6, 473, halves it for the share of time that it is used). Gate: all but 1e-5 of a χ² of three degrees of
/// freedom. New objects: one a frame in 60 m × 30 m/s × 1 rad.
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
