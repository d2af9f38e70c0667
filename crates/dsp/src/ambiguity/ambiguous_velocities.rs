//! Velocities that are indistinguishable in the points of a frame, and whether a vehicle can drive at another
//! one of them.

use artifact::Radar;

/// Maximum velocity of a hypothesis: 120 km/h. For two intervals 110 and 137 µs, folds up to here stay 3.4
/// m/s apart.
pub(crate) const FASTEST_MPS: f64 = 33.4;

/// Whether a radar's folds are observable between its slots: several slots at equal intervals.
pub(crate) fn folds_are_observable(radar: &Radar) -> bool {
    radar.slots() > 1 && radar.schedule.is_uniform()
}

/// Whether no other velocity that a vehicle can drive is a multiple of `ambiguity_mps` away from this one.
pub(crate) fn is_unambiguous(velocity_mps: f64, ambiguity_mps: f64) -> bool {
    ambiguity_mps - velocity_mps.abs() > FASTEST_MPS
}

/// Distance between indistinguishable velocities in the points of a frame: the map's span, or λ/2T where
/// folds are resolved.
pub(crate) fn ambiguity_mps(radar: &Radar) -> f64 {
    let slots = if folds_are_observable(radar) { radar.slots() } else { 1 };
    2.0 * slots as f64 * radar.velocity_max_mps()
}
