//! Position of an antenna relative to a body.

use glam::DVec3;
use std::f64::consts::TAU;

/// Position of an antenna, seen from the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standpoint {
    /// Azimuth from body x towards body y.
    pub azimuth_rad: f64,
    /// Elevation above the horizon.
    pub elevation_rad: f64,
    /// Distance to the origin; infinite for the far field.
    pub range_m: f64,
}

impl Standpoint {
    /// Unit vector from the origin.
    pub fn direction(&self) -> DVec3 {
        let (sin_el, cos_el) = self.elevation_rad.sin_cos();
        let (sin_az, cos_az) = self.azimuth_rad.sin_cos();
        DVec3::new(cos_el * cos_az, cos_el * sin_az, sin_el)
    }
}

/// Equivalent of an angle within half a turn of `near_rad`, rad.
pub fn nearest_turn(angle_rad: f64, near_rad: f64) -> f64 {
    angle_rad + TAU * ((near_rad - angle_rad) / TAU).round()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn directions_are_counted_from_x_towards_y_and_upwards() {
        for (azimuth_rad, elevation_rad, axis) in [
            (0.0, 0.0, DVec3::X),
            (FRAC_PI_2, 0.0, DVec3::Y),
            (PI, 0.0, -DVec3::X),
            (0.3, FRAC_PI_2, DVec3::Z),
        ] {
            let standpoint = Standpoint { azimuth_rad, elevation_rad, range_m: f64::INFINITY };
            // π is rounded by at most half a unit in its last place, ε.
            assert!((standpoint.direction() - axis).length() < 2.0 * f64::EPSILON, "{axis}");
        }
    }

    #[test]
    fn an_angle_moves_by_whole_turns_to_within_half_a_turn() {
        for (angle_rad, near_rad, turns) in
            [(3.0, -3.0, -1.0), (-3.0, 3.0, 1.0), (1.0, 2.0, 0.0), (0.5, 20.0, 3.0)]
        {
            let turned_rad = nearest_turn(angle_rad, near_rad);
            assert_eq!(turned_rad, angle_rad + turns * TAU, "{angle_rad} near {near_rad}");
            assert!((turned_rad - near_rad).abs() <= PI);
        }
    }
}
