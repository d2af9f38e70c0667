//! Doppler ambiguity: velocities that differ by whole spans 2·v_max = λ/2T are indistinguishable.

use artifact::radar::Radar;

/// A velocity wrapped to a map's axis, [−span/2, span/2), m/s.
pub fn wrapped_mps(velocity_mps: f64, span_mps: f64) -> f64 {
    let half = 0.5 * span_mps;
    (velocity_mps + half).rem_euclid(span_mps) - half
}

/// A velocity, or a difference of two, folded by whole spans to the value nearest to zero, m/s; values within
/// half a span are returned bit for bit.
pub fn folded_mps(velocity_mps: f64, span_mps: f64) -> f64 {
    folded(velocity_mps, span_mps)
}

/// A difference on any circle (of velocities, of a map's rows, of angles) folded by whole turns of it to the
/// value nearest to zero; values within half a turn are returned bit for bit.
pub fn folded(difference: f64, turn: f64) -> f64 {
    difference - turn * (difference / turn).round()
}

/// A velocity as it appears in a radar's map: folded into −v_max … +v_max, m/s.
pub fn apparent_velocity_mps(radar: &Radar, velocity_mps: f64) -> f64 {
    folded_mps(velocity_mps, 2.0 * radar.velocity_max_mps())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_spans_fold_away_and_nothing_is_beyond_half_of_one() {
        for (velocity_mps, folded) in [(0.0, 0.0), (3.0, 3.0), (7.0, -3.0), (-12.0, -2.0), (26.0, -4.0)] {
            assert_eq!(folded_mps(velocity_mps, 10.0), folded, "{velocity_mps}");
            assert_eq!(wrapped_mps(velocity_mps, 10.0), folded, "{velocity_mps}");
        }
        // Both ends of the axis are the same velocity.
        assert_eq!((wrapped_mps(5.0, 10.0), wrapped_mps(-5.0, 10.0)), (-5.0, -5.0));
    }
}
