//! Axes of a sensor on a pole as in vehicle datasets: the origin at the radar, x ahead along the boresight's
//! azimuth, y to the left, z up. They are levelled, without the tilt of the boresight, so that boxes on the
//! road are rotated only about z.

use artifact::Radar;
use glam::{DVec2, DVec3};
use radar::aperture::boresight_yaw_rad;

/// Position and yaw of a levelled sensor in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LevelledAxes {
    /// Position in world metres.
    pub(crate) origin_m: DVec3,
    /// Angle of the sensor's x axis from world +x towards +y.
    pub(crate) yaw_rad: f64,
}

impl LevelledAxes {
    /// Axes of a radar.
    pub(crate) fn of(radar: &Radar) -> Self {
        Self { origin_m: radar.position_m.into(), yaw_rad: boresight_yaw_rad(radar) }
    }

    /// Converts a place from the world's to the sensor's axes, m.
    pub(crate) fn of_world(&self, place_m: DVec3) -> DVec3 {
        turned(place_m - self.origin_m, -self.yaw_rad)
    }

    /// Converts a place from the sensor's to the world's axes, m.
    pub(crate) fn to_world(self, place_m: DVec3) -> DVec3 {
        self.origin_m + turned(place_m, self.yaw_rad)
    }

    /// Converts a yaw from the world's to the sensor's axes, in (−π, π].
    pub(crate) fn yaw_of_world(&self, yaw_rad: f64) -> f64 {
        wrapped(yaw_rad - self.yaw_rad)
    }
}

/// Wraps an angle into (−π, π].
pub(crate) fn wrapped(angle_rad: f64) -> f64 {
    let (sine, cosine) = angle_rad.sin_cos();
    sine.atan2(cosine)
}

fn turned(vector: DVec3, angle_rad: f64) -> DVec3 {
    DVec2::from_angle(angle_rad).rotate(vector.truncate()).extend(vector.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn ahead_is_x_left_is_y_and_the_way_back_is_the_same() {
        let axes = LevelledAxes { origin_m: DVec3::new(1.0, 2.0, 6.0), yaw_rad: FRAC_PI_2 };
        // The sensor looks along world +y: what is to its left has a lesser world x.
        let seen = axes.of_world(DVec3::new(0.0, 12.0, 1.0));
        assert!((seen - DVec3::new(10.0, 1.0, -5.0)).length() < 1e-12, "{seen}");
        assert!((axes.to_world(seen) - DVec3::new(0.0, 12.0, 1.0)).length() < 1e-12);
        assert!((axes.yaw_of_world(-FRAC_PI_2).abs() - std::f64::consts::PI).abs() < 1e-12);
    }
}
