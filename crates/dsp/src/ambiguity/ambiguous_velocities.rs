//! Velocities that look alike in the points of a frame, and those of them that no vehicle drives.

use artifact::Radar;

/// Faster is no hypothesis: 120 km/h. Of two intervals 110 and 137 µs, folds up to here stay 3.4 m/s apart.
pub(crate) const FASTEST_MPS: f64 = 33.4;

/// Whether a radar's folds show between its slots: several, at equal intervals.
pub(crate) fn folds_are_told(radar: &Radar) -> bool {
    radar.slots() > 1 && radar.schedule.is_uniform()
}

/// Whether no other velocity that a vehicle drives looks like this one, those that do `ambiguity_mps` apart.
pub(crate) fn no_other_is_driven(velocity_mps: f64, ambiguity_mps: f64) -> bool {
    ambiguity_mps - velocity_mps.abs() > FASTEST_MPS
}

/// Velocities this far apart look alike in the points of a frame: the map's span, or λ/2T where its folds are
/// told.
pub(crate) fn ambiguity_mps(radar: &Radar) -> f64 {
    let slots = if folds_are_told(radar) { radar.slots() } else { 1 };
    2.0 * slots as f64 * radar.velocity_max_mps()
}
